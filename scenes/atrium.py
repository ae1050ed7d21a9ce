#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""A cloister: a court within two storeys of arcades, hung with banners for a feast day.

The sky is one large light, and the sun a small strong one in its plane. One unit is a metre.
"""

import numpy as np

from atrium_parts import arcade, cloth, shell, vessels
from atrium_parts.level import Level
from atrium_parts.plan import (BAY, HALF_X, HALF_Z, LONG_SIDES, RAIL, SPRING, WALK, placed,
                               stations)
from model.generator import Model, run
from model.meshes import Y, joined, moved, rotated, scaled
from model.portable import PI
from model.shapes import quad

Array = np.ndarray

STANDARD = 0.2  # the level of the parts at which the scene has about 300 thousand triangles
SKY = 18.0  # its height
SKY_X, SKY_Z = (-13.0, 41.0), (-11.0, 10.5)  # so far that it ends behind the roofs
SKY_EXITANCE = 2.4
SUN = -5.0, -7.3  # its middle
SUN_HALF = 0.6
SUN_EXITANCE = 3600.0

BANNERS = [(0, 0), (0, 2), (2, -0.5), (2, -2.5)]  # side, the place in bays from its middle
POLE = 8.5  # the height of the banners' poles
CURTAINS = [(0, -2, 1), (0, 1, -1), (2, 2, -1), (2, -1, 1), (1, -1, 1), (1, 1, -1)]
# side, bay from its middle, and at which side of the arch the curtain is tied


def rectangle(x: tuple[float, float], z: tuple[float, float]) -> Array:
    return quad((x[0], SKY, z[0]), (x[1], SKY, z[0]), (x[1], SKY, z[1]), (x[0], SKY, z[1]))


def sun_edges() -> tuple[tuple[float, float], tuple[float, float]]:
    x, z = SUN
    return (x - SUN_HALF, x + SUN_HALF), (z - SUN_HALF, z + SUN_HALF)


def sky() -> Array:
    """A rectangle with a hole for the sun."""
    x, z = sun_edges()
    return joined(rectangle((SKY_X[0], x[0]), SKY_Z), rectangle((x[1], SKY_X[1]), SKY_Z),
                  rectangle(x, (SKY_Z[0], z[0])), rectangle(x, (z[1], SKY_Z[1])))


def banners(level: Level) -> Array:
    """They hang from poles that stand out of the walls above the colonnettes."""
    width, gap = 1.15, 0.75
    parts = []
    for i, (side, bay) in enumerate(BANNERS):
        hanging = cloth.banner(level, width, 3.0 + 0.3 * (i % 2), i)
        if level.has(0.02):
            hanging = joined(hanging, cloth.stay(level, gap + width / 2))
        hanging = rotated(hanging, Y, -PI / 2)
        parts.append(placed(hanging, stations(side, [bay * BAY], POLE, -gap - width / 2)))
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
    places = [(0, -1.5), (0, 1.5), (2, -1.5), (2, 0.5)]
    return joined([placed(vessels.tree(level, seed), stations(side, [bay * BAY], 0, -1.7))
                   for seed, (side, bay) in enumerate(places)])


def amphorae(level: Level) -> Array:
    """Around the fountain and in the corners of the court."""
    if level.coarse:
        return joined()
    x, z = HALF_X - 1.45, HALF_Z - 1.45
    places = [(x, z, 1.25), (-x, z, 1.25), (x, -z, 1.25), (-x, -z, 1.25)]
    places += [(sx * 1.62, sz * 1.62, 0.8) for sx in (1, -1) for sz in (1, -1)]
    parts = []
    for i, (x, z, size) in enumerate(places):
        jar = rotated(scaled(vessels.amphora(level), size), Y, 0.7 + 1.9 * i)
        parts.append(moved(jar, x, 0.14 if size < 1 else 0, z))
    return joined(parts)


def benches(level: Level) -> Array:
    if not level.has(0.01):
        return joined()
    return joined([placed(vessels.bench(level), stations(side, [place * BAY], 0, -1.5))
                   for side in LONG_SIDES for place in (-2.5, 0, 2.5)])


def build(detail: float) -> Model:
    level = Level(detail * STANDARD)
    parts = [arcade.lower_storey(level), arcade.string_course(level), arcade.balustrade(level),
             arcade.upper_storey(level), arcade.cornice(level), arcade.vaults(level),
             arcade.ceiling(level), shell.walls(level), shell.floors(level), shell.roof(level),
             vessels.fountain(level), banners(level), curtains(level), swags(level),
             trees(level), amphorae(level), benches(level)]
    x, z = sun_edges()
    return Model(joined(parts), lights=[(sky(), SKY_EXITANCE), (rectangle(x, z), SUN_EXITANCE)])


if __name__ == '__main__':
    run(__doc__, build)
