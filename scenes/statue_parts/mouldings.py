# SPDX-License-Identifier: GPL-3.0-only
"""Profiles and what is drawn along them."""

import numpy as np

from model.shapes import simplified, steps, surface

Array = np.ndarray

TOLERANCE = 0.004  # of the profiles in the standard scene


def profile(corners: list[tuple[float, ...]], detail: float) -> Array:
    """Points (n, 2) of a moulding. A corner (x, y, bulge) is reached by a curve, a corner (x, y)
    by a straight line. A curve bulges to the right of its way, or to the left if negative, by
    about half of `bulge` times its length."""
    points = [np.array(corners[0][:2], dtype=float)]
    for x, y, *bulge in corners[1:]:
        start, end = points[-1], np.array([x, y], dtype=float)
        if not bulge:
            points.append(end)
            continue
        across = np.array([end[1] - start[1], start[0] - end[0]])
        control = (start + end) / 2 + bulge[0] * across
        count = steps(7 * np.sqrt(detail), 1)
        for t in np.arange(1, count + 1) / count:
            points.append((1 - t) * (1 - t) * start + 2 * t * (1 - t) * control + t * t * end)
    return simplified(np.array(points), TOLERANCE / float(np.sqrt(detail)))


def around_pilaster(section: Array, half_width: float, depth: float) -> Array:
    """A profile of offsets and heights around the three free sides of a pilaster at z = 0."""
    offset, height = section[:, 0], section[:, 1]
    x, z = half_width + offset, depth + offset
    back = np.full_like(z, -0.05)
    path = [(-x, back), (-x, z), (x, z), (x, back)]
    return surface(np.stack([np.stack([px, height, pz], axis=-1) for px, pz in path]))


def straight(section: Array, x0: float, x1: float) -> Array:
    """A profile of offsets from the wall z = 0 and heights, drawn along x."""
    offset, height = section[:, 0], section[:, 1]
    return surface(np.stack([np.stack([np.full_like(offset, x), height, offset], axis=-1)
                             for x in (x0, x1)]))


def panel_frame(section: Array, low: tuple[float, float], high: tuple[float, float]) -> Array:
    """A profile of inward offsets and heights above the wall z = 0, around a rectangle."""
    inward, z = section[:, 0], section[:, 1]
    x0, y0 = low[0] + inward, low[1] + inward
    x1, y1 = high[0] - inward, high[1] - inward
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return surface(np.stack([np.stack([x, y, z], axis=-1) for x, y in corners]), closed_u=True)
