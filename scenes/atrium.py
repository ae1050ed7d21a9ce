#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""A cloister: a court within two storeys of arcades, hung with banners for a feast day.

The sky is one large light, and the sun a small strong one in its plane. One unit is a metre.
"""

import numpy as np

from atrium_parts import arcade, cloth, shell, vessels
from atrium_parts.level import Level
from atrium_parts.plan import (BAY, RAIL, RIDGE, SPRING, WALK, Stations, placed, stations,
                               united)
from model.generator import Model, run
from model.meshes import joined, moved, scaled
from model.shapes import quad

Array = np.ndarray

STANDARD = 0.3  # the level of the parts at which the scene has about 300 thousand triangles
SKY = 18.0  # its height
SKY_X, SKY_Z = (-14.0, 34.0), (-34.0, 10.5)
SKY_EXITANCE = 2.2
SUN = -5.0, -9.2  # its middle
SUN_HALF = 0.6
SUN_EXITANCE = 4200.0


def rectangle(x: tuple[float, float], z: tuple[float, float]) -> Array:
    return quad((x[0], SKY, z[0]), (x[1], SKY, z[0]), (x[1], SKY, z[1]), (x[0], SKY, z[1]))


def horizon() -> Array:
    """Where the sky comes down behind one end."""
    x, (z0, z1) = SKY_X[1], SKY_Z
    return quad((x, RIDGE, z0), (x, RIDGE, z1), (x, SKY, z1), (x, SKY, z0))


def sun_edges() -> tuple[tuple[float, float], tuple[float, float]]:
    x, z = SUN
    return (x - SUN_HALF, x + SUN_HALF), (z - SUN_HALF, z + SUN_HALF)


def sky() -> Array:
    """A rectangle with a hole for the sun."""
    x, z = sun_edges()
    return joined(rectangle((SKY_X[0], x[0]), SKY_Z), rectangle((x[1], SKY_X[1]), SKY_Z),
                  rectangle(x, (SKY_Z[0], z[0])), rectangle(x, (z[1], SKY_Z[1])), horizon())


BANNERS = [(0, -2.5, 3.9), (0, 0.5, 4.3), (0, 2.5, 3.9), (2, -2.5, 3.9), (2, -0.5, 4.3),
           (2, 2.5, 3.9)]  # side, the place in bays from its middle, length
CURTAINS = [(0, -2, 1), (0, 1, -1), (2, 2, -1), (2, -1, 1), (1, -1, 1), (1, 1, -1)]
# side, bay from the middle, at which side of the arch it is tied


def banners(level: Level) -> Array:
    width, reach, y = 1.25, 0.62, 8.0
    parts = []
    for seed, (side, bay, length) in enumerate(BANNERS):
        hanging = cloth.banner(level, width, length, seed)
        if level.has(0.02):
            hanging = joined(hanging, cloth.bracket(level, width, reach - 0.1))
        parts.append(placed(hanging, stations(side, [bay * BAY + BAY / 4], y, -reach)))
    return joined(parts)


def curtains(level: Level) -> Array:
    parts = []
    for seed, (side, bay, hand) in enumerate(CURTAINS):
        hanging = scaled(moved(cloth.curtain(level, 1.5, SPRING - WALK - 0.15, 100 + seed),
                               x=-BAY / 2 + 0.1), hand, 1, 1)
        parts.append(placed(hanging, stations(side, [bay * BAY], SPRING + 0.02, 0)))
    return joined(parts)


def swags(level: Level) -> Array:
    """Along the balustrade of both ends."""
    parts = []
    if level.coarse:
        return joined()
    for side in (1, 3):
        for i in range(6):
            hanging = cloth.swag(level, BAY / 2 - 0.04, 0.62, 200 + 10 * side + i)
            parts.append(placed(hanging, stations(side, [(i - 2.5) * BAY / 2], RAIL - 0.03, -0.2)))
    return joined(parts)


def trees(level: Level) -> Array:
    places = [(0, -1.5), (0, 1.5), (2, -1.5), (2, 1.5)]
    return joined([placed(vessels.tree(level, seed), stations(side, [bay * BAY], 0, -1.7))
                   for seed, (side, bay) in enumerate(places)])


def amphorae() -> Stations:
    return united([stations(0, np.array([-3, -1, 1, 3]) * BAY, WALK, -0.0 - 0.0),
                   stations(2, np.array([-3, -1, 1, 3]) * BAY, WALK, 0)])


def build(detail: float) -> Model:
    level = Level(detail * STANDARD)
    parts = [arcade.lower_storey(level), arcade.string_course(level), arcade.balustrade(level),
             arcade.upper_storey(level), arcade.cornice(level), arcade.vaults(level),
             arcade.ceiling(level), shell.walls(level), shell.floors(level), shell.roof(level),
             vessels.fountain(level), banners(level), curtains(level), swags(level),
             trees(level)]
    x, z = sun_edges()
    return Model(joined(parts), lights=[(sky(), SKY_EXITANCE), (rectangle(x, z), SUN_EXITANCE)])


if __name__ == '__main__':
    run(__doc__, build)
