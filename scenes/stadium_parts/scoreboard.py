# SPDX-License-Identifier: GPL-3.0-only
"""Score boards that hang from the roof at both ends: what they say is cut out of their front."""

import numpy as np

from model.meshes import joined, moved, rotated, Y
from model.portable import PI
from model.shapes import box, quad, surface, tubes

from . import plan

Array = np.ndarray

DIGITS = {'1': ('00100', '01100', '00100', '00100', '00100', '00100', '01110'),
          '4': ('00010', '00110', '01010', '10010', '11111', '00010', '00010'),
          '8': ('01110', '10001', '10001', '01110', '10001', '10001', '01110')}
TEXT = '418'  # RFC 2324: I'm a teapot
CELL, HOLE, DEPTH = 0.7, 0.58, 1.1  # sizes of a dot, of the hole that shows it, and of the board
MARGIN, BOTTOM, OFFSET = 0.8, 24.6, 8.0
HANGERS = 5.6  # their length


def dots() -> Array:
    """Whether each dot is on: (rows, columns), from the lower left."""
    rows = ['0'.join(DIGITS[digit][row] for digit in TEXT) for row in range(7)]
    return np.array([[dot == '1' for dot in row] for row in rows[::-1]])


def square(half: float, z: float) -> Array:
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    return np.concatenate([corners * half, np.full((4, 1), z)], axis=1)


def hole() -> Array:
    """A dot that is on: a rim, walls and a back wall."""
    rings = np.stack([square(CELL / 2, 0), square(HOLE / 2, 0), square(HOLE / 2, -0.7 * DEPTH)],
                     axis=1)
    return joined(surface(rings, closed_u=True), quad(*rings[:, 2]))


def board() -> Array:
    """Facing z, its lower edge on y = 0."""
    lit = dots()
    rows, columns = lit.shape
    width, height = columns * CELL / 2 + MARGIN, rows * CELL + 2 * MARGIN
    cells = [moved(hole() if lit[i, j] else quad(*square(CELL / 2, 0)),
                   (j - (columns - 1) / 2) * CELL, MARGIN + (i + 0.5) * CELL)
             for i, j in np.ndindex(rows, columns)]
    frame = [box((-width, 0, -DEPTH), (-width + MARGIN, height, 0.25)),
             box((width - MARGIN, 0, -DEPTH), (width, height, 0.25)),
             box((-width + MARGIN, 0, -DEPTH), (width - MARGIN, MARGIN, 0.25)),
             box((-width + MARGIN, height - MARGIN, -DEPTH), (width - MARGIN, height, 0.25))]
    hangers = tubes([[(x, height - 0.1, -DEPTH / 2), (x, height + HANGERS, -DEPTH / 2)]
                     for x in (-0.7 * width, 0.7 * width)], 0.12, 6)
    back = quad((-width, 0, -DEPTH), (width, 0, -DEPTH), (width, height, -DEPTH),
                (-width, height, -DEPTH)) - np.array([0, 0, 0.01])
    return joined(cells, frame, hangers, back)


def scoreboards() -> Array:
    x = float(plan.at(0.0, 0.0, OFFSET)[0])
    return joined(moved(rotated(board(), Y, -PI / 2), x, BOTTOM),
                  moved(rotated(board(), Y, PI / 2), -x, BOTTOM))
