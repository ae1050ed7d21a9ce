# SPDX-License-Identifier: GPL-3.0-only
"""The lights: a dome as an overcast sky, a part of which is the sun."""

import numpy as np

from model.portable import PI, cos, sin

Array = np.ndarray

BASE, TOP, RADIUS = 20.0, 98.0, 97.0
SEGMENTS, RINGS = 24, 6
SKY_EXITANCE, SUN_EXITANCE = 1.0, 70.0
SUN_RING, SUN_SEGMENTS = 3, (14, 15)  # cells of the dome


def dome() -> Array:
    """Cells (segments, rings, 4 corners, 3)."""
    longitude = np.arange(SEGMENTS + 1) * (2 * PI / SEGMENTS)
    latitude = np.arange(RINGS + 1) * (PI / 2 / RINGS)
    radius = RADIUS * cos(latitude)
    radius[-1] = 0
    points = np.stack(np.broadcast_arrays(
        radius * cos(longitude)[:, np.newaxis], BASE + (TOP - BASE) * sin(latitude),
        radius * sin(longitude)[:, np.newaxis]), axis=-1)
    points[-1] = points[0]
    return np.stack([points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]], axis=2)


def triangles(cells: Array) -> Array:
    a, b, c, d = (cells[:, i] for i in range(4))
    mesh = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return mesh[(mesh[:, 1] != mesh[:, 2]).any(axis=1)]


def sky() -> list[tuple[Array, float]]:
    cells = dome()
    is_sun = np.zeros(cells.shape[:2], dtype=bool)
    is_sun[list(SUN_SEGMENTS), SUN_RING] = True
    return [(triangles(cells[~is_sun]), SKY_EXITANCE), (triangles(cells[is_sun]), SUN_EXITANCE)]
