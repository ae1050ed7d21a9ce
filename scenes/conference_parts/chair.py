# SPDX-License-Identifier: GPL-3.0-only
"""A cantilever chair of bent steel tube with padded seat, back and armrests.

It stands on the origin and faces +z.
"""

import numpy as np

from model.meshes import joined, moved
from model.portable import exp
from model.shapes import rounded_box, steps

from .basics import COARSE, MEDIUM, bar, bent, cushion, mirrored, rounded_square, seam

Array = np.ndarray
TUBE, PIPING = 0.12, 0.045
RAIL_X = 2.55
FLOOR_Y, SEAT_Y, BACK_Y = 0.18, 4.25, 7.0
SEAT_SIZE = 2.36, 2.1  # halves of width and depth
BACK_SIZE = 2.36, 1.95  # halves of width and height
RECLINE = 0.2  # how far the back leans for each unit of height
CHANNELS = (-0.62, -0.2, 0.2, 0.62)  # where the back is stitched


def seat_shape(u: Array, v: Array, bulge: Array) -> Array:
    x, z = rounded_square(u, v, 0.14)
    front = np.maximum(0, v - 0.35)
    y = SEAT_Y + 0.08 * SEAT_SIZE[1] * z + 0.14 * x * x - 0.75 * front * front
    y = y + np.where(bulge > 0, 0.42, 0.24) * bulge
    return np.stack([SEAT_SIZE[0] * x, y, 0.1 + SEAT_SIZE[1] * z], axis=-1)


def back_shape(u: Array, v: Array, bulge: Array) -> Array:
    """Concave to hold the sitter, and convex where it supports the small of the back."""
    x, y = rounded_square(u, v, 0.16)
    stitches = sum(exp(-((v - at) * (v - at)) / 0.0016) for at in CHANNELS)
    depth = np.where(bulge > 0, 0.36 * (1 - 0.42 * stitches), 0.2) * bulge
    lumbar = 0.22 * exp(-(y + 0.45) * (y + 0.45) / 0.16)
    height = BACK_SIZE[1] * y
    z = -2.62 - RECLINE * height + 0.32 * x * x + lumbar + depth
    return np.stack([BACK_SIZE[0] * x, BACK_Y + height, z], axis=-1)


def rail_path(bend_steps: int) -> Array:
    """From the middle of the rear bar on the floor to the middle of the bar behind the back."""
    corners = [(0, FLOOR_Y, -2.3), (RAIL_X, FLOOR_Y, -2.3), (RAIL_X, FLOOR_Y, 2.35),
               (RAIL_X, 4.3, 2.05), (RAIL_X, 3.85, -1.9), (RAIL_X, 8.1, -2.72),
               (0, 8.1, -3.12)]
    return bent(corners, 0.75, bend_steps)


def frame(fine: float) -> Array:
    segments, bend_steps = steps(11 * fine, 2), steps(9 * fine, 0)
    if segments < 3:
        side = rail_path(0)[2:6]
        return joined(bar(side, TUBE, 2), bar(side * [-1, 1, 1], TUBE, 2))
    path = mirrored(rail_path(bend_steps))
    cross_bars = [bar(np.array([(-RAIL_X, y, z), (RAIL_X, y, z)]), 0.8 * TUBE, segments)
                  for y, z in [(4.08, 1.1), (3.9, -1.2)]]
    return joined(bar(path, TUBE, segments), cross_bars)


def armrest(fine: float) -> Array:
    """The right one."""
    corners = [(RAIL_X, 6.75, -2.45), (RAIL_X, 6.62, 1.7), (RAIL_X, 4.1, 1.3)]
    pad = rounded_box((RAIL_X - 0.28, 6.62, -1.7), (RAIL_X + 0.28, 6.98, 1.5), 0.16,
                      steps(4 * fine, 1))
    return joined(bar(bent(corners, 0.7, steps(8 * fine, 1)), 0.8 * TUBE, steps(9 * fine, 3)), pad)


def chair(fine: float) -> Array:
    columns = 1 if fine < COARSE else steps(24 * fine, 2)
    parts = [cushion(seat_shape, columns, columns), frame(fine)]
    parts.append(cushion(back_shape, columns, 1 if columns == 1 else steps(36 * fine, 2)))
    if fine > MEDIUM:
        right = armrest(fine)
        parts += [right, right * [-1, 1, 1]]
    if fine > 0.25:
        parts += [bar(seam(shape, columns), PIPING, steps(6 * fine, 3))
                  for shape in (seat_shape, back_shape)]
        parts += [moved(glide(fine), x, 0, z) for x in (-RAIL_X, RAIL_X) for z in (-1.5, 1.5)]
    return joined(parts)


def glide(fine: float) -> Array:
    """A ring around the tube that keeps it off the floor."""
    path = np.array([(0, FLOOR_Y, -0.12), (0, FLOOR_Y, 0.12)])
    return bar(path, TUBE + 0.05, steps(10 * fine, 4))
