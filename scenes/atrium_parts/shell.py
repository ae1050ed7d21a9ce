# SPDX-License-Identifier: GPL-3.0-only
"""The walls behind the walks with their niches and doors, the floors, and the roof."""

import numpy as np

from model.meshes import X, joined, moved, repeated, rotated
from model.noise import gradient_noise
from model.portable import PI, Random, cos, sin
from model.shapes import quad, surface

from . import order
from .arcade import coffer
from .level import Level
from .mouldings import archivolt, arc, jambs, pierced_wall, ring
from .plan import (BACK, BAY, CEILING, EAVES, GALLERY, HALF_X, HALF_Z, OUTSIDE, RIDGE, SIDES,
                   SPRING, WALK, Stations, between, depth, half_length, placed, stations, united)
from .vessels import urn

Array = np.ndarray

STEP = 0.95, 0.55  # how far the two steps lie before the axes of the columns
DOORS = {7: (1, 3, 5), 3: (1,)}  # which bays of a side have doors, by the number of its bays
JOINT = 0.006  # half the gap between two slabs
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


def niche(level: Level, width: float, floor: float, top: float) -> Array:
    """A bay of wall with a niche that ends in a fluted half dome."""
    radius, sill, spring = 0.46, floor + 0.95, floor + 2.15
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
    ledge = surface(np.stack([np.stack([s * cos(plan) * radius, np.full(len(plan), sill),
                                        s * sin(plan) * radius], -1) for s in (0.0, 1.0)], axis=1))
    shelf = level.outline([(0, -0.12), (0.05, -0.1), (0.09, -0.04, 0.3), (0.11, -0.04), (0.11, 0),
                           (0, 0.003)])
    bracket = surface(np.array([np.stack([np.full(len(shelf), u), shelf[:, 1] + sill,
                                          -shelf[:, 0]], -1) for u in (-0.66, 0.66)]))
    return joined(pierced_wall(width, floor - 0.02, top, radius, sill, spring, segments), shell, ledge,
                  bracket, surround(level, radius, sill, spring),
                  skirting(level, -width / 2, width / 2, floor))


def door(level: Level, width: float, floor: float, top: float) -> Array:
    """A bay of wall with a panelled double door under a round head."""
    radius, spring, reveal = 0.72, floor + 2.1, 0.22
    segments = level.segments(22, 4)
    if not level.has(0.05):
        return niche(level, width, floor, top)
    panel = rotated(joined(coffer(level, radius, (spring - floor) / 3)), X, PI / 2)
    rows = floor + (np.arange(3) + 0.5) * ((spring - floor) / 3)
    places = np.array([(side * radius / 2, y, reveal) for side in (-1, 1) for y in rows])
    leaves = repeated(panel, np.broadcast_to(np.eye(3), (len(places), 3, 3)), places)
    opening = arc(radius, radius, segments)
    head = surface(np.stack([np.stack([s * opening[:, 0], spring + s * opening[:, 1],
                                       np.full(len(opening), reveal)], -1)
                             for s in (0.0, 1.0)], axis=1))
    return joined(pierced_wall(width, floor - 0.02, top, radius, floor - 0.02, spring, segments),
                  jambs(radius, floor - 0.02, spring, reveal, segments), leaves, head,
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


def walls(level: Level) -> Array:
    top = SPRING + 1.6
    parts = [ring(np.array([(0, -0.05), (0, RIDGE)]), OUTSIDE)]
    if level.coarse:
        return joined(parts, ring(np.array([(0, 0), (0, CEILING)]), BACK))
    for floor, height in ((WALK, top), (GALLERY, CEILING + 0.05)):
        parts += [placed(niche(level, BAY, floor, height), bays(False)),
                  placed(door(level, BAY, floor, height), bays(True)),
                  placed(niche(level, BACK, floor, height), at_ends())]
    if level.has(0.03):
        parts.append(placed(order.pier(level), pilasters()))
        parts.append(ring(level.outline([(0, CEILING - 0.3), (0.03, CEILING - 0.28),
                                         (0.03, CEILING - 0.2), (0.12, CEILING - 0.08, -0.25),
                                         (0.14, CEILING - 0.08), (0.14, CEILING + 0.01)]), BACK))
    if level.has(0.15):
        matrices, offsets = united([bays(False), at_ends()])
        offsets = offsets + matrices[:, :, 2] * 0.1
        for floor in (WALK, GALLERY):
            parts.append(placed(moved(urn(level), y=floor + 0.95), (matrices, offsets)))
    return joined(parts)


def slabs(level: Level, low: tuple, high: tuple, size: tuple, y: float, seed: int) -> Array:
    """Worn stones in courses along u, each a bit out of level, with joints between them."""
    random = Random(seed)
    rows = max(1, int((high[1] - low[1]) / size[1] + 0.5))
    columns = max(1, int((high[0] - low[0]) / size[0] + 0.5))
    course = (high[1] - low[1]) / rows
    edges = low[0] + (np.arange(columns + 1) + 0.5 * (np.arange(rows)[:, np.newaxis] % 2)) * (
        (high[0] - low[0]) / columns)
    edges = edges + random.uniform(-0.12, 0.12, edges.shape) * size[0]
    edges = np.concatenate([np.full((rows, 1), low[0]), edges[:, 1:-1],
                            np.full((rows, 1), high[0])], axis=1)
    u0, u1 = edges[:, :-1].reshape(-1), edges[:, 1:].reshape(-1)
    w0 = np.repeat(low[1] + np.arange(rows) * course, columns)
    inner = level.segments(1)
    bevel = 0.035
    knots = np.concatenate([[0], bevel + (1 - 2 * bevel) * np.arange(inner + 1) / inner, [1]])
    s, t = np.meshgrid(knots, knots, indexing='ij')
    u = u0[:, None, None] + JOINT + (u1 - u0 - 2 * JOINT)[:, None, None] * s
    w = w0[:, None, None] + JOINT + (course - 2 * JOINT) * t
    tilt = random.uniform(-0.006, 0.006, (3, len(u0), 1, 1))
    edge = (s == 0) | (s == 1) | (t == 0) | (t == 1)
    wear = 0.008 * gradient_noise(np.stack([u * 1.7, w * 1.7, np.full(u.shape, seed + 0.5)], -1))
    height = y + tilt[0] + tilt[1] * (s - 0.5) + tilt[2] * (t - 0.5) + wear - 0.022 * edge
    return grids(np.stack([u, height, w], axis=-1))


def grids(points: Array) -> Array:
    """Two triangles for each cell of each of many grids (n, nu, nv, 3)."""
    a, b = points[:, :-1, :-1], points[:, 1:, :-1]
    c, d = points[:, 1:, 1:], points[:, :-1, 1:]
    return np.stack([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)],
                    axis=3).reshape(-1, 3, 3)


def floors(level: Level) -> Array:
    x, z = HALF_X + OUTSIDE, HALF_Z + OUTSIDE
    ground = quad((-x, -0.04, -z), (x, -0.04, -z), (x, -0.04, z), (-x, -0.04, z))
    first, second = STEP
    nosing = level.outline([(first, -0.04), (first, 0.14), (first + 0.015, 0.17, 0.6),
                            (second, 0.17), (second, WALK - 0.05), (second + 0.015, WALK - 0.02, 0.6),
                            (second - 0.03, WALK - 0.012), (second - 0.04, WALK - 0.05),
                            (-BACK, WALK - 0.05)])
    gallery = np.array([(-0.1, GALLERY - 0.04), (-BACK, GALLERY - 0.04)])
    parts = [ground, ring(nosing, 0), ring(gallery, 0)]
    if level.has(0.08):
        parts.append(slabs(level, (-HALF_X + first, -HALF_Z + first),
                           (HALF_X - first, HALF_Z - first), (0.74, 0.55), 0, 1))
        for side in SIDES:
            half, place = half_length(side), stations(side, [0])
            for y, edge in ((WALK, -second + 0.03), (GALLERY, 0.15)):
                parts.append(placed(slabs(level, (-half - edge, edge), (half + BACK, BACK),
                                          (0.7, 0.6), y, 10 + side), place))
    return joined(parts)


def roof(level: Level) -> Array:
    """Half-round tiles on a slope that falls towards the court."""
    slope = (RIDGE - EAVES) / (OUTSIDE - EDGE)
    plane = ring(np.array([(0.6, EAVES - 0.03), (-EDGE - 0.04, EAVES - 0.02), (-EDGE - 0.04, EAVES),
                           (-OUTSIDE, RIDGE)]), 0)
    if not level.has(0.1):
        return plane
    length = (OUTSIDE - EDGE) / COURSES
    tiles = []
    for side in SIDES:
        reach = half_length(side) + OUTSIDE
        columns = int(2 * reach / TILE)
        u = (np.arange(2 * columns) - columns + 0.5) * (TILE / 2)
        upper = np.arange(2 * columns) % 2
        w = EDGE + np.arange(COURSES) * length
        within = w + length > np.abs(u)[:, np.newaxis] - half_length(side)
        column, course = np.nonzero(within)
        for kind in (0, 1):
            chosen = upper[column] == kind
            places = stations(side, u[column[chosen]],
                              EAVES + 0.03 + slope * (w[course[chosen]] - EDGE), w[course[chosen]])
            places = jittered(places, side)
            tiles.append(placed(tile(level, length, slope, kind == 1), places))
            if kind:
                lowest = course[chosen] == 0
                tiles.append(placed(tile_end(level), (places[0][lowest], places[1][lowest])))
    return joined(plane, tiles)


def jittered(places: Stations, seed: int) -> Stations:
    matrices, offsets = places
    return matrices, offsets + Random(seed).uniform(-0.012, 0.012, offsets.shape)


def tile_end(level: Level) -> Array:
    """What closes the hollow of a covering tile at the eaves."""
    half = arc(0.1, 0.1, level.segments(5, 2))
    return surface(np.stack([np.stack([s * half[:, 0], 0.065 + s * half[:, 1],
                                       np.full(len(half), 0.015)], -1) for s in (0.0, 1.0)], axis=1))


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
