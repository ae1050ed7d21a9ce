# SPDX-License-Identifier: GPL-3.0-only
"""Lamps in the ceiling: a luminous panel in a housing, above a louvre of crossing blades.

The panel keeps its distance from all that it shines on, or paths that end there would be fireflies.
"""

import numpy as np

from model.meshes import joined, moved
from model.shapes import quad, steps, surface

from .basics import COARSE, boxes

Array = np.ndarray
HALF_LENGTH, HALF_WIDTH = 11, 6
BLADE_HEIGHT, BLADE_GAP = 0.4, 1.5
BLADE_WIDTH = 0.03, 0.07  # below and above; parabolic in between
PANEL_HEIGHT, HOUSING_HEIGHT = 3.4, 6.5  # above the ceiling
HOUSING_MARGIN = 3.0
RIM = 0.22


def panel(x: float, ceiling: float, z: float) -> Array:
    """The light, of the size of the opening."""
    a, b, y = HALF_LENGTH, HALF_WIDTH, ceiling + PANEL_HEIGHT
    return quad((x - a, y, z - b), (x + a, y, z - b), (x + a, y, z + b), (x - a, y, z + b))


def housing() -> Array:
    """It sits on the ceiling, wider than the opening."""
    a, b = HALF_LENGTH + HOUSING_MARGIN, HALF_WIDTH + HOUSING_MARGIN
    return boxes((-a, 0, -b), (a, HOUSING_HEIGHT, b), ('bottom',))


def collar() -> Array:
    """The sides of the opening, as high as the blades."""
    a, b = HALF_LENGTH, HALF_WIDTH
    return boxes((-a, 0, -b), (a, BLADE_HEIGHT, b), ('bottom', 'top'))


def rim() -> Array:
    """A narrow frame below the ceiling."""
    a, b = HALF_LENGTH, HALF_WIDTH
    long_sides = boxes([(-a - RIM, -0.08, -b - RIM), (-a - RIM, -0.08, b)],
                       [(a + RIM, 0, -b), (a + RIM, 0, b + RIM)], ('top',))
    short_sides = boxes([(-a - RIM, -0.08, -b), (a, -0.08, -b)],
                        [(-a, 0, b), (a + RIM, 0, b)], ('top', 'front', 'back'))
    return joined(long_sides, short_sides)


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
    """Below the panel; the origin is in the plane of the ceiling."""
    return joined(housing(), collar(), louvre(fine), rim() if fine > COARSE else [])
