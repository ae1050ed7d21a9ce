# SPDX-License-Identifier: GPL-3.0-only
"""The two storeys around the court: arches, cornices, vaults, and the walls behind the walks."""

import numpy as np

from model.meshes import X, joined, moved, rotated, scaled
from model.portable import PI, cos, sin
from model.shapes import box, lathe, quad, surface, tubes

from . import order
from .level import Level
from .mouldings import arc, archivolt, ring, soffit, spandrel
from .plan import (ARCH, BACK, BAY, CEILING, EAVES, ENTABLATURE, GALLERY, RAIL, SIDES, SPRING,
                   STRING_COURSE, UPPER_ARCH, UPPER_SPRING, WALL, between, corners, evenly,
                   half_length, placed, stations, united)

Array = np.ndarray

UPPER_BAY = BAY / 2
UPPER_WALL = 0.16  # half the thickness
RIB = 0.2  # half the width of the arches between vaults
BALUSTERS = 6  # between two pedestals
DENTIL = 0.075  # its width, and the gap to the next
MODILLION = BAY / 8  # from one to the next


def wall_above_arch(level: Level, width: float, radius: float, spring: float, top: float,
                    thickness: float, segments: int) -> Array:
    """A bay's wall with the arch, on both sides where that is to be seen."""
    opening = arc(radius, radius, segments)
    parts = [spandrel(width, top, opening, spring, -thickness),
             soffit(opening, spring, -thickness, thickness)]
    if level.has(0.01):
        parts.append(spandrel(width, top, opening, spring, thickness))
    return joined(parts)


def lower_arch(level: Level) -> Array:
    segments = level.segments(40, 2)
    parts = [wall_above_arch(level, BAY, ARCH, SPRING, STRING_COURSE + 0.1, WALL, segments)]
    if level.has(0.025):
        profile = level.outline([(0, 0.001), (0.05, 0.001), (0.05, 0.075), (0.065, 0.085, 0.3),
                                 (0.065, 0.16), (0.1, 0.195, -0.25), (0.115, 0.195),
                                 (0.115, 0.225), (0, 0.24)])
        front = moved(archivolt(profile, ARCH, SPRING, segments), z=-WALL)
        parts.append(front)
    if level.has(0.2):
        plain = level.outline([(0, 0.001), (0.04, 0.001), (0.04, 0.16), (0, 0.18)])
        parts.append(scaled(moved(archivolt(plain, ARCH, SPRING, segments), z=-WALL), 1, 1, -1))
    if level.has(0.05):
        parts.append(moved(keystone(level), z=-WALL))
    return joined(parts)


def keystone(level: Level) -> Array:
    """A scrolled bracket at the crown of an arch."""
    outline = level.outline([(0.06, -0.03), (0.15, -0.01, 0.4), (0.13, 0.08, -0.2),
                             (0.2, 0.3, -0.15), (0.0, 0.31)])
    half = np.array([0.075, 0.125])
    at = (outline[:, 1] + 0.03) / 0.34
    width = half[0] + (half[1] - half[0]) * at
    front = [np.stack([side * width, outline[:, 1], -outline[:, 0]], -1) for side in (-1, 1)]
    back = [np.stack([side * width, outline[:, 1], np.zeros(len(width))], -1) for side in (-1, 1)]
    mesh = surface(np.array([back[0], front[0], front[1], back[1]]))
    return moved(mesh, y=SPRING + ARCH)


def tondo(level: Level) -> Array:
    """A round medallion with a flower, between two arches."""
    profile = level.outline([(0.0, 0.035), (0.125, 0.012, -0.08), (0.15, 0.05), (0.165, 0.06, 0.4),
                             (0.18, 0.05, 0.4), (0.2, 0.0)])[::-1]
    dish = rotated(lathe(profile, level.segments(32, 8)), X, -PI / 2)
    flower = scaled(moved(order.rosette(level, 0.11), z=0.015), 1, 1, -1)
    return moved(joined(dish, flower), y=STRING_COURSE - 0.4, z=-WALL)


def tie_rod(level: Level) -> Array:
    return tubes([[(-BAY / 2, SPRING + 0.04, 0), (BAY / 2, SPRING + 0.04, 0)]], 0.018,
                 level.segments(8, 3), closed_ends=False)


def lower_storey(level: Level) -> Array:
    parts = [placed(lower_arch(level), evenly(BAY)), placed(order.column(level), between(BAY)),
             placed(order.pier(level), corners())]
    if level.has(0.05):
        parts.append(placed(tondo(level), between(BAY)))
    if level.has(0.1):
        parts.append(placed(tie_rod(level), evenly(BAY)))
    return joined(parts)


def string_course(level: Level) -> Array:
    """The entablature between the storeys, and the foot of the balustrade."""
    y = STRING_COURSE
    parts = [ring(level.outline([
        (0, y), (0.035, y), (0.035, y + 0.07), (0.05, y + 0.07), (0.05, y + 0.15),
        (0.085, y + 0.18, -0.3), (0.085, y + 0.195), (0.03, y + 0.195), (0.03, y + 0.33),
        (0.05, y + 0.35, 0.3), (0.05, y + 0.43), (0.13, y + 0.43), (0.15, y + 0.46, 0.3),
        (0.3, y + 0.46), (0.3, y + 0.53), (0.315, y + 0.53), (0.36, y + 0.6, 0.12),
        (0.36, y + 0.625), (0.0, y + 0.67), (-0.08, y + 0.67)]), -WALL)]
    if level.has(0.15):
        dentil = box((-DENTIL / 2, y + 0.355, -0.115), (DENTIL / 2, y + 0.425, 0))[2:]
        parts.append(placed(dentil, evenly(2 * DENTIL, WALL + 0.1, w=-WALL)))
    return joined(parts)


def balustrade(level: Level) -> Array:
    floor = GALLERY
    foot = [(0.15, floor + 0.2), (0.15, floor + 0.3), (0.13, floor + 0.34, 0.2),
            (-0.13, floor + 0.34), (-0.15, floor + 0.3, 0.2), (-0.15, floor - 0.02)]
    rail = [(-0.1, RAIL - 0.14), (0.1, RAIL - 0.14), (0.12, RAIL - 0.1, 0.2), (0.16, RAIL - 0.1),
            (0.18, RAIL - 0.03, 0.3), (0.16, RAIL), (-0.16, RAIL), (-0.18, RAIL - 0.03, 0.0),
            (-0.16, RAIL - 0.1, 0.3), (-0.12, RAIL - 0.1), (-0.1, RAIL - 0.14, 0.2)]
    parts = [ring(level.outline(foot), 0), ring(level.outline(rail[:6]), 0)]
    if level.has(0.01):
        parts.append(ring(level.outline(rail[5:]), 0))
    if level.has(0.03):
        parts += [placed(order.pedestal(level), between(UPPER_BAY)),
                  placed(order.baluster(level), balusters(level))]
    return joined(parts)


def balusters(level: Level) -> tuple[Array, Array]:
    """Where they stand: evenly between two pedestals."""
    count = BALUSTERS if level.has(0.1) else 3
    within = (np.arange(count) + 0.5) * ((UPPER_BAY - 0.36) / count) - (UPPER_BAY - 0.36) / 2
    places = []
    for side in SIDES:
        bays = int(2 * half_length(side) / UPPER_BAY + 0.5)
        middle = (np.arange(bays) + 0.5) * UPPER_BAY - half_length(side)
        places.append(stations(side, (middle[:, np.newaxis] + within).reshape(-1)))
    return united(places)


def upper_arch(level: Level) -> Array:
    segments = level.segments(18, 2)
    parts = [wall_above_arch(level, UPPER_BAY, UPPER_ARCH, UPPER_SPRING, ENTABLATURE + 0.2,
                             UPPER_WALL, segments)]
    if level.has(0.05):
        profile = level.outline([(0, 0.001), (0.03, 0.001), (0.03, 0.06), (0.06, 0.09, -0.25),
                                 (0.06, 0.11), (0, 0.12)])
        parts.append(moved(archivolt(profile, UPPER_ARCH, UPPER_SPRING, segments), z=-UPPER_WALL))
    return joined(parts)


def upper_masses() -> Array:
    """Every other colonnette, and a lintel for the arches."""
    lintel = ring(np.array([(UPPER_WALL, UPPER_SPRING + 0.3), (UPPER_WALL, ENTABLATURE + 0.1)]), 0)
    post = lathe([(0.12, RAIL), (0.12, UPPER_SPRING + 0.3)], 4)
    return joined(lintel, placed(post, between(BAY)))


def upper_storey(level: Level) -> Array:
    if level.coarse:
        return joined(upper_masses(), placed(order.upper_pier(level), corners()))
    return joined(placed(upper_arch(level), evenly(UPPER_BAY)),
                  placed(order.colonnette(level), between(UPPER_BAY)),
                  placed(order.upper_pier(level), corners()))


def modillion(level: Level) -> Array:
    """A bracket below the eaves."""
    outline = level.outline([(0, -0.16), (0.07, -0.15, 0.3), (0.16, -0.07, -0.25),
                             (0.3, -0.075, 0.3), (0.33, 0.0, 0.3)])
    sides = [np.stack([np.full(len(outline), u), outline[:, 1], -outline[:, 0]], -1)
             for u in (-0.06, 0.06)]
    back = [np.stack([np.full(len(outline), u), outline[:, 1], np.zeros(len(outline))], -1)
            for u in (-0.06, 0.06)]
    return surface(np.array([back[0], sides[0], sides[1], back[1]]))


def cornice(level: Level) -> Array:
    y = ENTABLATURE
    parts = [ring(level.outline([
        (0, y), (0.03, y), (0.03, y + 0.06), (0.045, y + 0.06), (0.045, y + 0.13),
        (0.07, y + 0.15, -0.3), (0.02, y + 0.15), (0.02, y + 0.4), (0.06, y + 0.44, 0.3),
        (0.4, y + 0.44), (0.4, y + 0.53), (0.43, y + 0.53), (0.5, y + 0.62, -0.2),
        (0.5, y + 0.66), (0.3, EAVES)]), -UPPER_WALL)]
    if level.has(0.08):
        parts.append(placed(moved(modillion(level), y=y + 0.44),
                            evenly(MODILLION, UPPER_WALL, w=-UPPER_WALL - 0.02)))
    return joined(parts)


def vault(level: Level, half_u: float, front: float) -> Array:
    """A groin vault: two barrels cross, and above each point hangs the higher one."""
    count = level.segments(15)
    angle = np.arange(count + 1) * (PI / 2 / count)
    u, rise = np.broadcast_arrays(1 - cos(angle)[:, np.newaxis], sin(angle))
    height = np.maximum(sin(angle)[:, np.newaxis], sin(angle))
    quarter = surface(np.stack([1 - u, height, 1 - u.T], axis=-1))
    half_w = (BACK - front) / 2
    whole = joined([scaled(quarter, su * half_u, 1.52, sw * half_w)
                    for su in (-1, 1) for sw in (-1, 1)])
    return moved(whole, y=SPRING, z=front + half_w)


def transverse_arch(level: Level) -> Array:
    """Between two vaults, from a column to the wall behind it."""
    half_w = (BACK - WALL) / 2
    opening = arc(half_w, 1.4, level.segments(30, 3))
    top = SPRING + 1.6
    across = joined(spandrel(2 * half_w, top, opening, SPRING, -RIB),
                    spandrel(2 * half_w, top, opening, SPRING, RIB),
                    soffit(opening, SPRING, -RIB, RIB))
    turned = np.stack([-across[..., 2], across[..., 1], across[..., 0]], axis=-1)
    return moved(turned, z=WALL + half_w)


def vaults(level: Level) -> Array:
    if level.coarse:
        return ring(np.array([(0, SPRING + 1.5), (-BACK, SPRING + 1.5)]), 0)
    ribs = united([between(BAY), *(stations(side, [half_length(side), -half_length(side)])
                                   for side in SIDES)])
    cornering = united([stations(side, [half_length(side) + (BACK + RIB) / 2])
                        for side in SIDES])
    return joined(placed(vault(level, BAY / 2 - RIB, WALL), evenly(BAY)),
                  placed(vault(level, (BACK - RIB) / 2, RIB), cornering),
                  placed(transverse_arch(level), ribs))


def coffer(level: Level, width: float, depth: float) -> Array:
    """One field of the ceiling, with its lower edge at y = 0 about the origin."""
    steps = level.outline([(0.0, 0), (0.09, 0), (0.1, 0.03, -0.25), (0.12, 0.08), (0.15, 0.08),
                           (0.19, 0.14, -0.25), (0.22, 0.14)])
    loops = [np.stack([su * (width / 2 - steps[:, 0]), steps[:, 1],
                       sw * (depth / 2 - steps[:, 0])], axis=-1)
             for su, sw in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    inner = [loop[-1] for loop in loops]
    parts = [surface(np.array(loops), closed_u=True), quad(*inner)]
    if level.has(0.3):
        flower = rotated(order.rosette(level, 0.12), X, PI / 2)
        parts.append(moved(flower, y=0.14))
    return joined(parts)


def ceiling(level: Level) -> Array:
    """The coffers above the gallery."""
    depth, front = (BACK - UPPER_WALL) / 3, UPPER_WALL
    rows = front + (np.arange(3) + 0.5) * depth
    if not level.has(0.04):
        return ring(np.array([(0, CEILING), (-BACK, CEILING)]), 0)
    straight = united([evenly(UPPER_BAY / 2, y=CEILING, w=w) for w in rows])
    length = BACK / 4
    corner = (np.arange(4) + 0.5) * length
    around = united([stations(side, half_length(side) + corner, CEILING, w)
                     for side in SIDES for w in rows])
    strip = united([stations(side, [half_length(side) + 0.5 * BACK], CEILING, 0)
                    for side in SIDES])
    edge = quad((-BACK / 2, 0, 0), (BACK / 2, 0, 0), (BACK / 2, 0, UPPER_WALL),
                (-BACK / 2, 0, UPPER_WALL))
    return joined(placed(coffer(level, UPPER_BAY / 2, depth), straight),
                  placed(coffer(level, length, depth), around), placed(edge, strip))
