# SPDX-License-Identifier: GPL-3.0-only
"""The lights: a dome as an overcast sky, a part of which is the sun."""

import numpy as np

from model.portable import PI, cos, sin

Array = np.ndarray

BASE, TOP, RADIUS = 20.0, 98.0, 97.0
SEGMENTS, RINGS = 16, 6
LOW_RINGS = 2  # seen only between roof and stands, and from high seats; they are darker
LOW_EXITANCE, HIGH_EXITANCE, SUN_EXITANCE = 0.5, 1.0, 240.0
SUN_SEGMENT, SUN_RING = 11, 3  # the cell of the dome that is the sun


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
    kind = np.ones(cells.shape[:2], dtype=np.int64)
    kind[:, :LOW_RINGS] = 0
    kind[SUN_SEGMENT, SUN_RING] = 2
    exitances = LOW_EXITANCE, HIGH_EXITANCE, SUN_EXITANCE
    return [(triangles(cells[kind == i]), exitance) for i, exitance in enumerate(exitances)]
