#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""A furnished conference room for two dozen people, between lamp grids and venetian blinds.

One unit is 100 mm. The table runs along x; windows are in the wall of -z, bookcases and the screen
at the wall of -x, whiteboard and door at the wall of +z.
"""

import numpy as np

from conference_parts import desk, fittings, lamps, plant, room, shelves, tableware, windows
from conference_parts import table as tables
from conference_parts.basics import COARSE, MEDIUM, placed, standing
from conference_parts.chair import chair
from model.generator import Model, run
from model.meshes import joined, moved
from model.portable import PI, Random, cos, sin

Array = np.ndarray
TABLE_X = -2.0
SEATS_X = np.arange(10) * 6.1 - 27.45
SEAT_DISTANCE = 2.9  # from the edge of the table to the middle of a chair
STRAY_CHAIRS = [(-38.0, 25.5, 2.6), (20.5, -29.0, 0.25)]  # x, z, angle
BLINDS = [(9.3, 0.72), (13.5, 0.62), (9.3, 0.8), (9.3, 0.68)]  # lowest point, tilt of each
LAMP_EXITANCE, SKY_EXITANCE = 4.0, 1.3


def seats() -> Array:
    """At the edge of the table, (x, z, angle in which the sitter looks), in the frame of the
    table."""
    width = tables.half_width(SEATS_X)
    sides = [np.stack([SEATS_X, side * width, np.full(10, PI if side > 0 else 0.0)], axis=-1)
             for side in (-1, 1)]
    ends = np.array([(-tables.HALF_LENGTH, 0, PI / 2), (tables.HALF_LENGTH, 0, -PI / 2)])
    return np.concatenate([*sides, ends])


def ahead(spots: Array, forward: Array, aside: Array, y: float, turn: Array) -> Array:
    """Spots (x, y, z, angle) that lie before seats, and to the left of the sitters."""
    x, z, angle = spots.T
    look = np.stack([sin(angle), cos(angle)], axis=-1)
    return np.stack([x + forward * look[:, 0] + aside * look[:, 1], np.full(len(x), y),
                     z + forward * look[:, 1] - aside * look[:, 0], angle + turn], axis=-1)


def chairs(fine: float) -> Array:
    """Moved and turned a little, as people leave them."""
    random, spots = Random(1), seats()
    count = len(spots)
    spots = ahead(spots, -SEAT_DISTANCE - random.uniform(-0.5, 0.9, count),
                  random.uniform(-0.25, 0.25, count), room.PLANK[2],
                  random.normal(count) * 0.09)
    spots[:, 0] += TABLE_X
    strays = np.array([(x, room.PLANK[2], z, angle) for x, z, angle in STRAY_CHAIRS])
    return standing(chair(fine), np.concatenate([spots, strays]))


def at_places(fine: float) -> list[Array]:
    """What lies on the table before the seats."""
    random, spots = Random(2), seats()
    count = len(spots)

    def lay(mesh: Array, wanted: Array, forward: float, aside: float, turn: float = 0.12) -> Array:
        jitter = random.uniform(-0.22, 0.22, (3, count))
        at = ahead(spots, forward + jitter[0], aside + jitter[1], tables.TOP, turn * 4 * jitter[2])
        return standing(mesh, at[wanted])

    kind = random.uniform(0, 1, count)
    kind[-1] = 0
    has_laptop = kind < 0.45
    inner = np.abs(spots[:, 0]) < SEATS_X[-1]  # not beside the round corners of the table
    third = np.arange(count) % 3
    parts = [lay(desk.laptop(opening, fine), has_laptop & (third == i), 0.9, 0.0, 0.2)
             for i, opening in enumerate((1.75, 1.9, 2.05))]
    if fine < COARSE:
        return parts
    parts += [lay(desk.papers(4, 0.1, fine, 3), ~has_laptop & (kind < 0.7), 2.2, 0.0),
              lay(desk.notebook(fine), has_laptop & (kind < 0.3) & inner, 1.9, 3.0, 0.3),
              lay(desk.folder(fine), (kind >= 0.7) & (kind < 0.85), 2.3, 0.1, 0.3),
              lay(desk.notebook(fine), kind >= 0.85, 1.9, 0.2, 0.4)]
    if fine < MEDIUM:
        return parts
    parts += [lay(desk.pen(fine), kind >= 0.45, 2.1, -1.55, 1.5),
              lay(tableware.cup_and_saucer(fine), random.uniform(0, 1, count) < 0.7, 4.4, -2.3, 3),
              lay(tableware.glass(fine), random.uniform(0, 1, count) < 0.6, 4.9, -0.6)]
    return parts


def along_the_middle(fine: float) -> list[Array]:
    """What stands on the table for all."""
    tray = joined(tableware.tray(fine), moved(tableware.carafe(fine), -0.6, 0.08, 0.3),
                  [moved(tableware.glass(fine), x, 0.08, z)
                   for x, z in ((0.6, -0.7), (1.0, 0.25), (0.2, 1.1))])
    things = [(tray, -16, 0.4, 0.3), (tray, 15.6, -0.3, 2.0), (desk.phone(fine), 0, 0, 0.4),
              (tableware.fruit_bowl(fine), 3.9, 0.4, 0),
              (desk.remote_control(fine), -3.2, 0.9, 0.8)]
    return [placed(mesh, x, tables.TOP, z, turn) for mesh, x, z, turn in things]


def on_sideboard(fine: float) -> list[Array]:
    x, y = 2.8 - room.HALF_LENGTH, fittings.SIDEBOARD[1] + room.PLANK[2]
    glasses = [moved(tableware.glass(fine), 0.3 * i - 0.4, 0.08, 0.85 * i - 1.1) for i in range(3)]
    things = [(joined(tableware.tray(fine), *glasses), -10.5), (tableware.vase(fine), 8.2),
              (tableware.globe(fine), 11.4), (tableware.cup_and_saucer(fine), -7.4),
              (desk.folder(fine), 4.6)]
    return [placed(mesh, x, y, z, 0.4 * i) for i, (mesh, z) in enumerate(things)]


def furniture(fine: float) -> list[Array]:
    a, b, floor = room.HALF_LENGTH, room.HALF_WIDTH, room.PLANK[2]
    wall, width = PI / 2, shelves.WIDTH
    parts = [placed(shelves.bookcase(fine, 41), -a, floor, b - 0.6, wall),
             placed(shelves.bookcase(fine, 42), -a, floor, -b + 0.6 + width, wall),
             placed(fittings.screen(fine), -a + 0.45, 17.2, 0, wall),
             placed(fittings.sideboard(fine), -a + 0.5, floor, 0, wall),
             placed(fittings.whiteboard(fine), -16, 15, b, PI),
             placed(plant.plant(15, 5, 24, fine, 7), 0.5, floor, -29.8)]
    if fine > COARSE:
        parts += [placed(fittings.slat_panel(fine), -a, floor, 0, wall),
                  placed(fittings.flip_chart(fine), -37, floor, 29.0, 2.7),
                  placed(fittings.clock(fine), -24, 21, -b),
                  placed(fittings.picture(fine), 28, 16, b, PI),
                  placed(plant.plant(12, 4, 20, fine, 8), 44.5, floor, -29.5),
                  placed(fittings.projector(fine), 6, room.HEIGHT, 0)]
    if fine > MEDIUM:
        parts += [placed(fittings.waste_basket(fine), -1.2, floor, b - 1.8),
                  *on_sideboard(fine)]
        parts += [placed(fittings.air_outlet(fine), x, room.HEIGHT, 0) for x in (-32, 34)]
    return parts


def build(detail: float) -> Model:
    fine = float(np.sqrt(detail))
    middle = along_the_middle(fine) if fine > MEDIUM else []
    on_table = [tables.table(fine), *at_places(fine), *middle]
    walls = [moved(windows.window(lowest, tilt, fine, seed), x, 0, -room.HALF_WIDTH)
             for seed, (x, (lowest, tilt)) in enumerate(zip(room.WINDOWS_X, BLINDS))]
    geometry = joined(room.room(fine), walls, furniture(fine), chairs(fine),
                      moved(joined(on_table), TABLE_X, 0, 0))
    panels = joined([lamps.panel(x, room.HEIGHT, z) for x in room.LAMPS_X for z in room.LAMPS_Z])
    return Model(geometry, lights=[(room.sky(), SKY_EXITANCE), (panels, LAMP_EXITANCE)],
                 reflectance=0.65)


if __name__ == '__main__':
    run(__doc__, build)
