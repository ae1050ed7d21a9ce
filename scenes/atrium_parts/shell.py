# SPDX-License-Identifier: GPL-3.0-only
"""The walls behind the walks with their niches and doors, the floors, and the roof."""

import numpy as np

from model.meshes import X, joined, moved, repeated, rotated
from model.noise import gradient_noise
from model.portable import PI, Random, cos, sin
from model.shapes import halves, quad, surface

from . import order
from .arcade import coffer
from .level import Level
from .mouldings import arc, archivolt, jambs, pierced_wall, ring
from .plan import (BACK, BAY, CEILING, EAVES, GALLERY, HALF_X, HALF_Z, OUTSIDE, RIDGE, SIDES,
                   SPRING, WALK, Stations, between, half_length, placed, stations, united)
from .vessels import urn

Array = np.ndarray

SILL = 0.95  # of the niches, above the floor
STEP = 0.95, 0.55  # how far the two steps lie before the axes of the columns
DOORS = {7: (1, 3, 5), 3: (1,)}  # which bays of a side have doors, by the number of its bays
JOINT = 0.006  # half the gap between two slabs
BEVEL = 0.035  # of a slab, relative to its size
TILE, COURSES = 0.29, 5  # the pitch of the roof tiles, and how many lie one above the other
EDGE = -0.78  # of the roof


def skirting(level: Level, u0: float, u1: float, floor: float) -> Array:
    profile = level.outline([(0.07, floor - 0.02), (0.07, floor + 0.2), (0.05, floor + 0.21),
                             (0.03, floor + 0.26, -0.3), (0.03, floor + 0.28), (0, floor + 0.29)])
    return surface(np.array([np.stack([np.full(len(profile), u), profile[:, 1], -profile[:, 0]],
                                      axis=-1) for u in (u0, u1)]))


def surround(level: Level, radius: float, sill: float, spring: float) -> Array:
    profile = level.outline([(0, 0.001), (0.05, 0.001), (0.05, 0.07), (0.08, 0.11, -0.25),
                             (0.09, 0.11), (0.09, 0.14), (0, 0.15)])
    return archivolt(profile, radius, spring, level.segments(20, 3), sill)


def fan(edge: Array, middle: tuple[float, float, float]) -> Array:
    """A flat piece between a curved edge (n, 3) and a point."""
    return surface(np.stack([np.broadcast_to(middle, edge.shape), edge], axis=1))


def niche(level: Level, width: float, floor: float, top: float) -> Array:
    """A bay of wall with a niche that ends in a fluted half dome."""
    radius, sill, spring = 0.46, floor + SILL, floor + 2.15
    if not level.has(0.05):
        return quad((-width / 2, floor, 0), (width / 2, floor, 0), (width / 2, top, 0),
                    (-width / 2, top, 0))
    segments = level.segments(22, 4)
    ribs = 11
    plan = np.arange(2 * segments + 1) * (PI / (2 * segments))
    rise = np.arange(segments // 2 + 1) * (PI / 2 / (segments // 2))
    flute = 1 - 0.05 * np.abs(sin(plan * ribs))[:, np.newaxis] * sin(rise)
    inside = np.concatenate([np.ones((len(plan), 1)), flute * cos(rise)], axis=1) * radius
    height = np.concatenate([[sill], spring + radius * sin(rise)])
    shell = surface(np.stack(np.broadcast_arrays(
        inside * cos(plan)[:, np.newaxis], height, inside * sin(plan)[:, np.newaxis]), axis=-1))
    rim = np.stack([radius * cos(plan), np.full(len(plan), sill), radius * sin(plan)], axis=-1)
    shelf = level.outline([(0, -0.12), (0.05, -0.1), (0.09, -0.04, 0.3), (0.11, -0.04), (0.11, 0),
                           (0, 0.003)])
    bracket = surface(np.array([np.stack([np.full(len(shelf), u), shelf[:, 1] + sill,
                                          -shelf[:, 0]], -1) for u in (-0.66, 0.66)]))
    return joined(pierced_wall(width, floor - 0.02, top, radius, sill, spring, segments), shell,
                  fan(rim, (0, sill, 0)), bracket, surround(level, radius, sill, spring),
                  skirting(level, -width / 2, width / 2, floor))


def door(level: Level, width: float, floor: float, top: float) -> Array:
    """A bay of wall with a panelled double door under a round head."""
    radius, spring, reveal = 0.72, floor + 2.1, 0.22
    segments = level.segments(22, 4)
    if not level.has(0.05):
        return niche(level, width, floor, top)
    panel = rotated(coffer(level, radius, (spring - floor) / 3), X, PI / 2)
    rows = floor + (np.arange(3) + 0.5) * ((spring - floor) / 3)
    places = np.array([(side * radius / 2, y, reveal) for side in (-1, 1) for y in rows])
    leaves = repeated(panel, np.broadcast_to(np.eye(3), (len(places), 3, 3)), places)
    opening = arc(radius, radius, segments)
    edge = np.stack([opening[:, 0], spring + opening[:, 1], np.full(len(opening), reveal)], -1)
    return joined(pierced_wall(width, floor - 0.02, top, radius, floor - 0.02, spring, segments),
                  jambs(radius, floor - 0.02, spring, reveal, segments), leaves,
                  fan(edge, (0, spring, reveal)),
                  surround(level, radius, floor - 0.02, spring),
                  skirting(level, -width / 2, -radius - 0.14, floor),
                  skirting(level, radius + 0.14, width / 2, floor))


def bays(with_door: bool) -> Stations:
    places = []
    for side in SIDES:
        count = int(2 * half_length(side) / BAY + 0.5)
        chosen = [i for i in range(count) if (i in DOORS[count]) == with_door]
        middle = (np.array(chosen) + 0.5) * BAY - half_length(side)
        places.append(stations(side, middle, w=BACK))
    return united(places)


def at_ends() -> Stations:
    """The walls that close the walks beyond the corners of the court."""
    return united([stations(side, np.array([-1, 1]) * (half_length(side) + BACK / 2), w=BACK)
                   for side in SIDES])


def pilasters() -> Stations:
    ends = [stations(side, np.array([-1, 1]) * half_length(side)) for side in SIDES]
    matrices, offsets = united([between(BAY), *ends])
    return matrices, offsets + matrices[:, :, 2] * (BACK + 0.12)


def gallery_cornice(level: Level) -> Array:
    return ring(level.outline([(0, CEILING - 0.3), (0.03, CEILING - 0.28), (0.03, CEILING - 0.2),
                               (0.12, CEILING - 0.08, -0.25), (0.14, CEILING - 0.08),
                               (0.14, CEILING + 0.01)]), BACK)


def urns(level: Level) -> Array:
    """One in each niche."""
    matrices, offsets = united([bays(False), at_ends()])
    offsets = offsets + matrices[:, :, 2] * 0.1
    return joined([placed(moved(urn(level), y=floor + SILL), (matrices, offsets))
                   for floor in (WALK, GALLERY)])


def walls(level: Level) -> Array:
    parts = [ring(np.array([(0, -0.05), (0, RIDGE)]), OUTSIDE)]
    if level.coarse:
        return joined(parts, ring(np.array([(0, 0), (0, CEILING)]), BACK))
    for floor, top in ((WALK, SPRING + 1.6), (GALLERY, CEILING + 0.05)):
        parts += [placed(niche(level, BAY, floor, top), bays(False)),
                  placed(door(level, BAY, floor, top), bays(True)),
                  placed(niche(level, BACK, floor, top), at_ends())]
    if level.has(0.03):
        parts += [placed(order.pier(level), pilasters()), gallery_cornice(level)]
    if level.has(0.15):
        parts.append(urns(level))
    return joined(parts)


def courses(low: tuple, high: tuple, size: tuple, random: Random) -> tuple[Array, Array, float]:
    """Stones of uneven length in a running bond: their ends (n, 2) along u, where each begins in w,
    and the depth of a course."""
    rows = max(1, int((high[1] - low[1]) / size[1] + 0.5))
    columns = max(1, int((high[0] - low[0]) / size[0] + 0.5))
    shift = 0.5 * (np.arange(rows)[:, np.newaxis] % 2)
    edges = low[0] + (np.arange(columns + 1) + shift) * ((high[0] - low[0]) / columns)
    edges += random.uniform(-0.12, 0.12, edges.shape) * size[0]
    edges[:, 0], edges[:, -1] = low[0], high[0]
    depth = (high[1] - low[1]) / rows
    ends = np.stack([edges[:, :-1], edges[:, 1:]], axis=-1).reshape(-1, 2)
    return ends, np.repeat(low[1] + np.arange(rows) * depth, columns), depth


def slabs(level: Level, low: tuple, high: tuple, size: tuple, y: float, seed: int) -> Array:
    """Worn stones, each a bit out of level, with joints between them."""
    random = Random(seed)
    ends, start, depth = courses(low, high, size, random)
    inner = level.segments(1)
    knots = np.concatenate([[0], BEVEL + (1 - 2 * BEVEL) * np.arange(inner + 1) / inner, [1]])
    s, t = np.meshgrid(knots, knots, indexing='ij')
    first, last = (ends[:, i, np.newaxis, np.newaxis] for i in (0, 1))
    u = first + JOINT + (last - first - 2 * JOINT) * s
    w = start[:, np.newaxis, np.newaxis] + JOINT + (depth - 2 * JOINT) * t
    tilt = random.uniform(-0.006, 0.006, (3, len(u), 1, 1))
    edge = (s == 0) | (s == 1) | (t == 0) | (t == 1)
    wear = 0.008 * gradient_noise(np.stack([u * 1.7, w * 1.7, np.full(u.shape, seed + 0.5)], -1))
    height = y + tilt[0] + tilt[1] * (s - 0.5) + tilt[2] * (t - 0.5) + wear - 0.022 * edge
    return grids(np.stack([u, height, w], axis=-1))


def grids(points: Array) -> Array:
    """Two triangles for each cell of each of many grids (n, nu, nv, 3)."""
    a, b = points[:, :-1, :-1], points[:, 1:, :-1]
    c, d = points[:, 1:, 1:], points[:, :-1, 1:]
    return halves(a, b, c, d).reshape(-1, 3, 3)


def floors(level: Level) -> Array:
    x, z = HALF_X + OUTSIDE, HALF_Z + OUTSIDE
    ground = quad((-x, -0.04, -z), (x, -0.04, -z), (x, -0.04, z), (-x, -0.04, z))
    first, second = STEP
    nosing = level.outline([(first, -0.04), (first, 0.14), (first + 0.015, 0.17, 0.6),
                            (second, 0.17), (second, WALK - 0.05),
                            (second + 0.015, WALK - 0.02, 0.6), (second - 0.03, WALK - 0.012),
                            (second - 0.04, WALK - 0.05),
                            (-BACK, WALK - 0.05)])
    gallery = np.array([(-0.1, GALLERY - 0.04), (-BACK, GALLERY - 0.04)])
    parts = [ground, ring(nosing, 0), ring(gallery, 0)]
    if level.has(0.06):
        parts.append(slabs(level, (-HALF_X + first, -HALF_Z + first),
                           (HALF_X - first, HALF_Z - first), (0.74, 0.55), 0, 1))
        for side in SIDES:
            half, place = half_length(side), stations(side, [0])
            for y, edge in ((WALK, -second + 0.03), (GALLERY, 0.15)):
                parts.append(placed(slabs(level, (-half - edge, edge), (half + BACK, BACK),
                                          (0.7, 0.6), y, 10 + side), place))
    return joined(parts)


def tile_places(side: int, covering: bool, slope: float) -> tuple[Stations, Array]:
    """Where the tiles of one side lie, and which of them lie lowest."""
    length, half = (OUTSIDE - EDGE) / COURSES, half_length(side)
    columns = int(2 * (half + OUTSIDE) / TILE)
    u = (np.arange(columns) - columns / 2 + (0.75 if covering else 0.25)) * TILE
    w = EDGE + np.arange(COURSES) * length
    column, course = np.nonzero(w + length > np.abs(u)[:, np.newaxis] - half)
    places = stations(side, u[column], EAVES + 0.03 + slope * (w[course] - EDGE), w[course])
    return jittered(places, 2 * side + covering), course == 0


def roof(level: Level) -> Array:
    """Half-round tiles on a slope that falls towards the court."""
    slope = (RIDGE - EAVES) / (OUTSIDE - EDGE)
    lip = -EDGE - 0.04
    parts = [ring(np.array([(0.6, EAVES - 0.03), (lip, EAVES - 0.02), (lip, EAVES),
                            (-OUTSIDE, RIDGE)]), 0)]
    if not level.has(0.1):
        return joined(parts)
    length = (OUTSIDE - EDGE) / COURSES
    for side in SIDES:
        for covering in (False, True):
            places, lowest = tile_places(side, covering, slope)
            parts.append(placed(tile(level, length, slope, covering), places))
            if covering:
                parts.append(placed(tile_end(level), (places[0][lowest], places[1][lowest])))
    return joined(parts)


def jittered(places: Stations, seed: int) -> Stations:
    matrices, offsets = places
    return matrices, offsets + Random(seed).uniform(-0.012, 0.012, offsets.shape)


def tile_end(level: Level) -> Array:
    """What closes the hollow of a covering tile at the eaves."""
    half = arc(0.1, 0.1, level.segments(5, 2))
    edge = np.stack([half[:, 0], 0.065 + half[:, 1], np.full(len(half), 0.015)], axis=-1)
    return fan(edge, (0, 0.065, 0.015))


def tile(level: Level, length: float, slope: float, covering: bool) -> Array:
    count = level.segments(5, 2)
    angle = np.arange(count + 1) * (PI / count)
    radius = np.array([0.1, 0.085]) if covering else np.array([0.075, 0.09])
    along = np.array([0, length + 0.06])
    lift = np.array([0.045, 0.015]) + slope * along
    sign = 1 if covering else -1
    offset = 0.02 if covering else 0.07
    points = np.stack(np.broadcast_arrays(
        cos(angle)[:, np.newaxis] * radius,
        offset + lift + sign * sin(angle)[:, np.newaxis] * radius, along), axis=-1)
    return surface(points)
