# SPDX-License-Identifier: GPL-3.0-only
"""The Utah teapot of Martin Newell, 1975: 32 bicubic Bezier patches.

The numbers are those of his published data (F. C. Crow, "The Origins of the Teapot", IEEE Computer
Graphics and Applications 7(1), 1987). Only what is not symmetric is kept of the 306 control points:
the profiles of the patches that run around the axis, and half the cross-sections of handle and
spout. The walls have no thickness, lid and rim do not touch, and the spout is open, as published.
"""

import numpy as np

from model.meshes import joined
from model.shapes import surface

Array = np.ndarray

# Radius, radius of the two inner control points of a quarter of a turn, and height of each ring
# of control points. Each curve has four, and begins with the last of the one before.
BODY = [(1.4, 0.784, 2.4), (1.3375, 0.749, 2.53125), (1.4375, 0.805, 2.53125), (1.5, 0.84, 2.4),
        (1.75, 0.98, 1.875), (2.0, 1.12, 1.35), (2.0, 1.12, 0.9),
        (2.0, 1.12, 0.45), (1.5, 0.84, 0.225), (1.5, 0.84, 0.15),
        (1.5, 0.84, 0.075), (1.425, 0.798, 0.0), (0.0, 0.0, 0.0)]
LID = [(0.0, 0.0, 3.15), (0.8, 0.45, 3.15), (0.0, 0.0, 2.85), (0.2, 0.112, 2.7),
       (0.4, 0.224, 2.55), (1.3, 0.728, 2.55), (1.3, 0.728, 2.4)]

# Place (x, height) of the inner and of the outer side of each cross-section, and half its width.
HANDLE = [(-1.6, 2.025, -1.5, 2.25, 0.3), (-2.3, 2.025, -2.5, 2.25, 0.3),
          (-2.7, 2.025, -3.0, 2.25, 0.3), (-2.7, 1.8, -3.0, 1.8, 0.3),
          (-2.7, 1.575, -3.0, 1.35, 0.3), (-2.5, 1.125, -2.65, 0.9375, 0.3),
          (-2.0, 0.9, -1.9, 0.6, 0.3)]
SPOUT = [(1.7, 1.425, 1.7, 0.6, 0.66), (2.6, 1.425, 3.1, 0.825, 0.66),
         (2.3, 2.1, 2.4, 2.025, 0.25), (2.7, 2.4, 3.3, 2.4, 0.25),
         (2.8, 2.475, 3.525, 2.49375, 0.25), (2.9, 2.475, 3.45, 2.5125, 0.15),
         (2.8, 2.4, 3.2, 2.4, 0.15)]


def curve(points: Array, segments: int) -> Array:
    """Points (..., segments + 1, d) of the Bezier curve of four control points (..., 4, d). Its
    ends are the first and the last of them, to the bit."""
    t = (np.arange(segments + 1) / segments)[:, np.newaxis]
    s = 1 - t
    a, b, c, d = (points[..., np.newaxis, i, :] for i in range(4))
    return s * s * s * a + 3 * (s * s * t * b + s * t * t * c) + t * t * t * d


def patches(control: Array, segments: int) -> Array:
    """Points (n, segments + 1, 3) of patches one after the other, from rows (rows, 4, 3) of control
    points. Neighbours share a row, and so the points of their border."""
    along = np.concatenate([curve(control[i:i + 4].swapaxes(0, 1), segments).swapaxes(0, 1)[i > 0:]
                            for i in range(0, len(control) - 1, 3)])
    return curve(along, segments)


def turned(rings: list[tuple[float, float, float]], segments: int) -> Array:
    """A quarter, and its three rotations about the axis."""
    control = np.array([[(r, h, 0), (r, h, inner), (inner, h, r), (0, h, r)]
                        for r, inner, h in rings], dtype=float)
    quarter = patches(control, segments)
    x, y, z = np.moveaxis(quarter, -1, 0)
    quarters = [np.stack(rotated, axis=-1) for rotated in
                ((x, y, z), (-z, y, x), (-x, y, -z), (z, y, -x))]
    ring = np.concatenate([q[:, :-1] for q in quarters], axis=1)
    return surface(ring + 0.0, closed_v=True)  # + 0.0 makes zeros of both signs one


def mirrored(sections: list[tuple[float, float, float, float, float]], segments: int) -> Array:
    """A half, and its mirror image."""
    control = np.array([[(x0, y0, 0), (x0, y0, w), (x1, y1, w), (x1, y1, 0)]
                        for x0, y0, x1, y1, w in sections], dtype=float)
    half = patches(control, segments)
    other = half[:, ::-1] * np.array([1.0, 1.0, -1.0])
    ring = np.concatenate([half[:, :-1], other[:, :-1]], axis=1)
    return surface(ring + 0.0, closed_v=True)


def teapot(segments: int) -> Array:
    """About the y axis on the floor, spout towards x; each patch has 2 * segments**2 triangles."""
    return joined(turned(BODY, segments), turned(LID, segments),
                  mirrored(HANDLE, segments), mirrored(SPOUT, segments))
