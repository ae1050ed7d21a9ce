# SPDX-License-Identifier: GPL-3.0-only
"""What belongs to each window: frame, sill, venetian blind and radiator.

The origin is in the plane of the wall, below the middle of the window; the room is towards +z.
"""

import numpy as np

from model.meshes import X, joined, moved
from model.portable import Random, cos, sin
from model.shapes import rounded_box, steps, surface

from .basics import COARSE, MEDIUM, bar, bent, boxes
from .room import WINDOW_HALF_WIDTH, WINDOW_HIGH, WINDOW_LOW

Array = np.ndarray
FRAME_Z = -2.6
SLAT_GAP, SLAT_WIDTH, SLAT_CAMBER = 0.42, 0.48, 0.045
BLIND_Z = -0.75
BLIND_HALF_WIDTH = WINDOW_HALF_WIDTH - 0.15
HEAD_RAIL = WINDOW_HIGH - 0.45
STACK_GAP = 0.06  # between slats that lie on one another
RADIATOR_LENGTH, RADIATOR_LOW, RADIATOR_HIGH = 15.0, 1.3, 7.0


def frame() -> Array:
    """Fixed frame and two casements, each with a bar at two thirds of the height."""
    a, low, high = WINDOW_HALF_WIDTH + 0.02, WINDOW_LOW - 0.02, WINDOW_HIGH + 0.02
    transom = low + 0.68 * (high - low)
    pieces = [((-a, low, 0), (-a + 0.7, high, 0.7)), ((a - 0.7, low, 0), (a, high, 0.7)),
              ((-a + 0.6, low, 0.01), (a - 0.6, low + 0.7, 0.69)),
              ((-a + 0.6, high - 0.7, 0.01), (a - 0.6, high, 0.69)),
              ((-0.45, low + 0.6, -0.02), (0.45, high - 0.6, 0.75)),
              ((-a + 0.6, transom - 0.3, 0.05), (a - 0.6, transom + 0.3, 0.6))]
    low, high = (np.array(corner, dtype=float) for corner in zip(*pieces))
    return moved(boxes(low, high), 0, 0, FRAME_Z)


def sill(fine: float) -> Array:
    a = WINDOW_HALF_WIDTH
    if fine < COARSE:
        return boxes((-a, WINDOW_LOW - 0.1, FRAME_Z), (a, WINDOW_LOW + 0.1, 1.5),
                     ('bottom', 'left', 'right', 'front', 'back'))
    board = rounded_box((-a - 0.6, WINDOW_LOW - 0.25, -0.05), (a + 0.6, WINDOW_LOW + 0.1, 1.5),
                        0.12, steps(4 * fine, 1))
    inner = boxes((-a - 0.04, WINDOW_LOW - 0.1, FRAME_Z + 0.1), (a + 0.04, WINDOW_LOW + 0.08, 0.3),
                  ('bottom', 'back'))
    return joined(board, inner)


def slats(heights: Array, tilts: Array, width: float, across: int) -> Array:
    """Curved strips; those of a positive tilt have their inner edge lower."""
    t = np.arange(across + 1) / across * 2 - 1
    along = t * (width / 2)
    camber = SLAT_CAMBER * (1 - t * t)
    c, s = cos(tilts)[:, np.newaxis], sin(tilts)[:, np.newaxis]
    z = BLIND_Z + along * c + camber * s
    y = heights[:, np.newaxis] - along * s + camber * c
    ends = [np.stack([np.full_like(y, x), y, z], axis=-1)
            for x in (-BLIND_HALF_WIDTH, BLIND_HALF_WIDTH)]
    return joined([surface(np.stack(pair)) for pair in zip(*ends)])


def blind(lowest: float, tilt: float, fine: float, seed: int) -> Array:
    """Let down to a height; the slats beyond lie stacked on the bottom rail."""
    random = Random(seed)
    coarser = 1 / min(1, 2.2 * fine)
    gap, width = SLAT_GAP * coarser, SLAT_WIDTH * coarser
    total = int((HEAD_RAIL - WINDOW_LOW - 0.5) / gap)
    hanging = int((HEAD_RAIL - lowest - 0.2) / gap)
    stacked = (total - hanging) if fine > COARSE else 0
    tilts = tilt + random.uniform(-0.03, 0.03, hanging)
    heights = HEAD_RAIL - 0.2 - gap * (np.arange(hanging) + 0.5)
    stack_top = HEAD_RAIL - 0.2 - gap * hanging - 0.1
    lying = stack_top - STACK_GAP * np.arange(stacked)
    across = steps(5 * fine, 1)
    rail_y = stack_top - STACK_GAP * stacked
    rail = np.array([-BLIND_HALF_WIDTH, rail_y - 0.25, BLIND_Z - 0.25])
    parts = [slats(heights, tilts, width, across), head_rail()]
    if stacked:
        parts.append(slats(lying, random.uniform(-0.02, 0.02, stacked), width, across))
    if fine > COARSE:
        parts.append(rounded_box(rail, -rail * [1, 0, 0] + [0, rail_y - 0.02, BLIND_Z + 0.25],
                                 0.08, steps(3 * fine, 1)))
        parts.append(cords(rail_y - 0.1, fine))
    return joined(parts)


def head_rail() -> Array:
    return boxes((-BLIND_HALF_WIDTH, HEAD_RAIL - 0.1, BLIND_Z - 0.35),
                 (BLIND_HALF_WIDTH, WINDOW_HIGH - 0.02, BLIND_Z + 0.35))


def cords(bottom: float, fine: float) -> Array:
    """Ladders before and behind the slats, and the rod that turns them."""
    segments = steps(6 * fine, 3)
    ladders = [bar(np.array([(x, bottom, BLIND_Z + z), (x, HEAD_RAIL, BLIND_Z + z)]), 0.022,
                   segments)
               for x in (-8.4, -2.8, 2.8, 8.4) for z in (-0.27, 0.27)]
    x = -BLIND_HALF_WIDTH + 0.9
    rod = bar(np.array([(x, HEAD_RAIL - 10, BLIND_Z + 0.45), (x, HEAD_RAIL, BLIND_Z + 0.4)]), 0.05,
              segments)
    return joined(ladders, rod)


def radiator(fine: float) -> Array:
    """A row of elements, each of two columns that join at top and bottom, on two pipes."""
    a, low, high = RADIATOR_LENGTH / 2, RADIATOR_LOW, RADIATOR_HIGH
    if fine < MEDIUM:
        return boxes((-a, low, 0), (a, high, 1.2), ('bottom', 'back'))
    count = steps(34 * min(1, fine), 3)
    pitch = RADIATOR_LENGTH / count
    corners = [(0, low, 0.75), (0, low, 1.25), (0, high, 1.25), (0, high, 0.35),
               (0, low, 0.35), (0, low, 0.8)]
    element = bar(bent(corners, 0.25, steps(5 * fine, 1)), min(0.16, pitch * 0.4),
                  steps(9 * fine, 3))
    elements = [moved(element, -a + (i + 0.5) * pitch) for i in range(count)]
    pipes = [bar(np.array([(-a, y, 0.8), (a, y, 0.8)]), 0.12, steps(9 * fine, 3))
             for y in (low + 0.05, high - 0.05)]
    return joined(elements, pipes, valve(fine))


def valve(fine: float) -> Array:
    a = RADIATOR_LENGTH / 2
    along = np.array([-0.1, 0.35, 0.36, 1])[:, np.newaxis]
    path = np.array([a, RADIATOR_HIGH - 0.05, 0.8]) + along * X
    head = bar(path, np.array([0.12, 0.12, 0.26, 0.22]), steps(16 * fine, 4))
    pipe = bar(bent([(a - 0.1, RADIATOR_LOW, 0.8), (a + 0.5, RADIATOR_LOW, 0.8),
                     (a + 0.5, -0.05, 0.8)], 0.3,
                    steps(6 * fine, 1)), 0.1, steps(9 * fine, 3))
    return joined(head, pipe)


def window(lowest: float, tilt: float, fine: float, seed: int) -> Array:
    parts = [blind(lowest, tilt, fine, seed), sill(fine), radiator(fine)]
    if fine > COARSE:
        parts.append(frame())
    return joined(parts)
