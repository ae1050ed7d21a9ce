# SPDX-License-Identifier: GPL-3.0-only
"""Lamps: luminous panels in the plane of the ceiling, and below each a louvre of crossing blades.

Nothing stands near a panel in front of it, or paths that end there would be fireflies: a louvre 2.2
below its panel gives the average intensity four times the variance.
"""

import numpy as np

from model.meshes import joined, moved
from model.shapes import quad, steps, surface

from .basics import COARSE, bar, boxes

Array = np.ndarray
HALF_LENGTH, HALF_WIDTH = 11.0, 6.0
BLADE_HEIGHT, BLADE_GAP = 0.4, 1.5
BLADE_WIDTH = 0.03, 0.07  # below and above; parabolic in between
DROP = 4.0  # of the lower edges below the ceiling
RIM = 0.12
WIRE = 0.03


def panel(x: float, ceiling: float, z: float) -> Array:
    """The light; it fits the hole of the ceiling."""
    a, b = HALF_LENGTH, HALF_WIDTH
    return quad((x - a, ceiling, z - b), (x + a, ceiling, z - b), (x + a, ceiling, z + b),
                (x - a, ceiling, z + b))


def rim() -> Array:
    """The frame that holds the blades."""
    a, b, top = HALF_LENGTH, HALF_WIDTH, BLADE_HEIGHT + 0.04
    long_sides = boxes([(-a - RIM, 0, -b - RIM), (-a - RIM, 0, b)],
                       [(a + RIM, top, -b), (a + RIM, top, b + RIM)])
    short_sides = boxes([(-a - RIM, 0, -b), (a, 0, -b)], [(-a, top, b), (a + RIM, top, b)],
                        ('front', 'back'))
    return joined(long_sides, short_sides)


def wires(fine: float) -> Array:
    """From the ceiling to the long sides of the rim."""
    return joined([bar(np.array([(x, BLADE_HEIGHT, z), (x, DROP + 0.05, z)]), WIRE,
                       steps(7 * fine, 3))
                   for x in (-0.7 * HALF_LENGTH, 0.7 * HALF_LENGTH)
                   for z in (-HALF_WIDTH - RIM / 2, HALF_WIDTH + RIM / 2)])


def blade_section(fine: float) -> Array:
    """Half widths and heights (n, 2) around a blade from below, open above."""
    count = steps(5 * fine, 1)
    t = np.arange(count + 1) / count
    half = np.stack([BLADE_WIDTH[0] / 2 + (BLADE_WIDTH[1] - BLADE_WIDTH[0]) / 2 * t * t,
                     0.02 + BLADE_HEIGHT * t], axis=-1)
    return np.concatenate([half[::-1] * [-1, 1], half])


def blades(count: int, spacing: float, half_length: float, fine: float) -> Array:
    """Along x, side by side along z; plain sheets where the lamp is coarse."""
    if fine < 0.2:
        section = np.array([(0, 0.02), (0, BLADE_HEIGHT)])
    else:
        section = blade_section(fine)
    meshes = []
    for i in range(count):
        z = (i - (count - 1) / 2) * spacing
        ends = [np.stack([np.full(len(section), x), section[:, 1], z + section[:, 0]], axis=-1)
                for x in (-half_length, half_length)]
        meshes.append(surface(np.stack(ends)))
    return joined(meshes)


def louvre(fine: float) -> Array:
    wider = 1 / min(1, 2 * fine)  # fewer and wider cells where the lamp is coarse
    along = steps(2 * HALF_WIDTH / (BLADE_GAP * wider), 2) - 1
    across = steps(2 * HALF_LENGTH / (BLADE_GAP * wider), 3) - 1
    crossing = blades(across, 2 * HALF_LENGTH / (across + 1), HALF_WIDTH, fine)
    return joined(blades(along, 2 * HALF_WIDTH / (along + 1), HALF_LENGTH, fine),
                  moved(crossing[..., [2, 1, 0]], 0, 0.01, 0))


def lamp(fine: float) -> Array:
    """What hangs below the panel; the origin is in the plane of the ceiling."""
    parts = [louvre(fine)]
    if fine > COARSE:
        parts += [rim(), wires(fine)]
    return moved(joined(parts), 0, -DROP, 0)
