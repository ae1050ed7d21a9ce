# SPDX-License-Identifier: GPL-3.0-only
"""Columns with their bases and capitals, piers, colonnettes and balusters."""

import numpy as np

from model.meshes import Y, joined, moved, repeated, scaled
from model.portable import PI, cos, sin, smoothstep
from model.shapes import circle, lathe, spline, surface, tubes
from model.vectors import rotation

from .level import Level
from .mouldings import square
from .plan import GALLERY, RAIL, SPRING, UPPER_SPRING, WALK

Array = np.ndarray

FOOT, NECK = 0.225, 0.19  # radii of the shaft
SHAFT = 0.33, 2.56  # heights above the walk
CAPITAL = SPRING - WALK - SHAFT[1]
FLUTES, FLUTE_DEPTH = 20, 0.02
ABACUS = 0.31  # half its width
LEAVES = 8  # in each of two rows


def around(mesh: Array, count: int, first: float = 0) -> Array:
    """Copies about the y axis."""
    angle = first + np.arange(count) * (2 * PI / count)
    return repeated(mesh, rotation(Y, angle), np.zeros((count, 3)))


def base(level: Level) -> Array:
    """An Attic base: two tori and a scotia between them, on a plinth."""
    rounds = level.outline([(0.31, 0.11), (0.31, 0.2, 0.5), (0.275, 0.2), (0.275, 0.215),
                            (0.25, 0.255, -0.35), (0.25, 0.267), (0.25, 0.315, 0.5),
                            (0.236, 0.315), (FOOT, 0.335, -0.2)])
    plinth = level.outline([(0.325, -0.02), (0.325, 0.11), (0.2, 0.11)])
    return joined(square(plinth), lathe(rounds, level.segments(32, 4)))


def shaft_radius(t: Array) -> Array:
    """With entasis: straight for the lower third, then drawn in ever more."""
    rest = np.maximum(0, (np.asarray(t, dtype=float) - 0.33) / 0.67)
    return FOOT - (FOOT - NECK) * rest * rest * (1.6 - 0.6 * rest)


def shaft(level: Level) -> Array:
    bottom, top = SHAFT
    if not level.has(0.15):
        rows = np.arange(level.segments(4) + 1) / level.segments(4)
        heights = bottom + (top - bottom) * rows
        return lathe(np.stack([shaft_radius(rows), heights], -1), level.segments(20, 4))
    across, along = level.segments(4, 3), level.segments(8, 2)
    end = np.arange(level.segments(3, 2)) / level.segments(3, 2) * 0.035
    rows = np.concatenate([end, 0.035 + 0.93 * np.arange(along + 1) / along, 1 - end[::-1]])
    groove = np.concatenate([[0], 0.14 + 0.86 * np.arange(across) / across])
    hollow = FLUTE_DEPTH * sin(PI * np.clip((groove - 0.14) / 0.86, 0, 1))
    angle = ((np.arange(FLUTES)[:, np.newaxis] + groove) * (-2 * PI / FLUTES)).reshape(-1)
    ends = smoothstep(0, 0.03, rows) * smoothstep(0, 0.03, 1 - rows)
    radius = shaft_radius(rows) - np.tile(hollow, FLUTES)[:, np.newaxis] * np.sqrt(ends)
    height = np.broadcast_to(bottom + (top - bottom) * rows, radius.shape)
    return surface(np.stack([radius * cos(angle)[:, np.newaxis], height,
                             radius * sin(angle)[:, np.newaxis]], axis=-1), closed_u=True)


def leaf(level: Level, height: float, reach: float, width: float) -> Array:
    """An acanthus leaf standing at the origin, whose tip curls over towards +z."""
    along, half = level.segments(12, 3), level.segments(3)
    spine = spline(np.array([(0, 0), (0.06, 0.42), (0.2, 0.78), (0.55, 1.0), (0.95, 0.96),
                             (1.0, 0.8)]), along + 1)
    t = (np.arange(along + 1) / along)[:, np.newaxis]
    s = np.arange(-half, half + 1) / half
    lobes = 1 + 0.16 * cos(t * 9 * PI)
    breadth = width / 2 * lobes * (0.78 + 0.5 * t - 0.95 * t * t * t)
    ribs = 0.09 * cos(s * 2 * PI) - 0.3 * s * s
    points = np.stack(np.broadcast_arrays(
        breadth * s, height * (spine[:, 1:] - 0.06 * s * s),
        reach * spine[:, :1] + ribs * width * (0.35 + 0.65 * t)), axis=-1)
    return surface(points.transpose(1, 0, 2))


def volute(level: Level) -> Array:
    """A stalk that rises from the bell towards +z and rolls up below the abacus."""
    count = level.segments(30, 5)
    t = np.arange(count + 1) / count
    turn = np.clip((t - 0.3) / 0.7, 0, 1)
    angle = PI * 0.75 - turn * 3.4 * PI
    radius = 0.075 * (1 - 0.78 * turn)
    rolled = np.stack([0.3 + radius * cos(angle), 0.425 + radius * sin(angle)], axis=-1)
    stalk = spline(np.array([(0.185, 0.2), (0.2, 0.36), rolled[0]]), 9)
    rise = np.clip(t / 0.3, 0, 1) * 8
    path = np.stack([np.interp(rise, np.arange(9), stalk[:, i]) for i in (0, 1)], axis=-1)
    path = np.where((t < 0.3)[:, np.newaxis], path, rolled)
    points = np.stack([np.zeros(count + 1), path[:, 1], path[:, 0]], axis=-1)
    return scaled(tubes(points, 0.021 - 0.01 * t, level.segments(8, 3)), 1.6, 1, 1)


def abacus(level: Level) -> Array:
    """A slab with hollow sides and cut corners, moulded at its edge."""
    profile = level.outline([(0.86, 0), (0.9, 0.035, -0.25), (0.9, 0.05), (1, 0.075, 0.25),
                             (1, 0.11), (0.3, 0.11)])
    across = level.segments(8)
    s = (np.arange(across + 1) / across) * 2 - 1
    edge = np.stack([s * ABACUS * 0.93, ABACUS * (0.86 + 0.14 * s * s)], axis=-1)
    if not level.has(0.1):
        return square(profile * np.array([ABACUS, 1]))
    outline = np.concatenate([np.stack([edge[:, 0], edge[:, 1]], -1),
                              np.stack([edge[:, 1], -edge[:, 0]], -1),
                              np.stack([-edge[:, 0], -edge[:, 1]], -1),
                              np.stack([-edge[:, 1], edge[:, 0]], -1)])
    height = np.broadcast_to(profile[:, 1], (len(outline), len(profile)))
    return surface(np.stack([outline[:, :1] * profile[:, 0], height,
                             outline[:, 1:] * profile[:, 0]], axis=-1), closed_u=True)


def capital(level: Level) -> Array:
    """Two rows of leaves around a bell, a volute below each corner of the abacus."""
    bell = level.outline([(NECK, -0.03), (0.215, -0.015, 0.5), (NECK, 0.0, 0.5), (NECK, 0.12),
                          (0.25, CAPITAL - 0.11, -0.12)])
    parts = [lathe(bell, level.segments(24, 4)), moved(abacus(level), y=CAPITAL - 0.11)]
    if level.has(0.05):
        lower = moved(leaf(level, 0.24, 0.1, 0.165), y=0.01, z=NECK + 0.012)
        upper = moved(leaf(level, 0.37, 0.115, 0.155), y=0.03, z=NECK + 0.006)
        parts += [around(lower, LEAVES), around(upper, LEAVES, PI / LEAVES)]
    if level.has(0.03):
        parts += [around(volute(level), 4, PI / 4)]
    if level.has(0.2):
        parts += [around(moved(rosette(level, 0.055), y=CAPITAL - 0.05, z=0.265), 4)]
    return joined(parts)


def rosette(level: Level, radius: float) -> Array:
    """A flower of six petals on a wall to -z, or on whatever stands behind it."""
    around_it, out = level.segments(24, 6), level.segments(5, 2)
    ring = circle(around_it)
    t = np.arange(out + 1) / out
    lobe = 0.8 + 0.2 * np.abs(cos(np.arange(around_it) * (6 * PI / around_it)))
    bulge = np.where(t < 0.25, 0.5, 0.42 * sin(PI * np.clip(t, 0.25, 1)))
    points = np.stack(np.broadcast_arrays(ring[:, :1] * lobe[:, np.newaxis] * t,
                                          ring[:, 1:] * lobe[:, np.newaxis] * t, bulge), axis=-1)
    return scaled(surface(points, closed_u=True), radius)


def column(level: Level) -> Array:
    """From the walk to the springing of the arches."""
    if level.coarse:
        return lathe([(FOOT, WALK), (NECK, SPRING)], 4)
    return moved(joined(base(level), shaft(level), moved(capital(level), y=SHAFT[1])), y=WALK)


def pier(level: Level) -> Array:
    """The square support at a corner of the court."""
    low, high = SHAFT[0], SPRING - WALK
    if level.coarse:
        return square(np.array([(0.3, WALK), (0.3, SPRING)]))
    return moved(square(level.outline([
        (0.34, -0.02), (0.34, 0.12), (0.33, 0.2, 0.4), (0.3, 0.2), (0.29, 0.26, -0.3),
        (0.29, low), (0.27, low + 0.02), (0.27, high - 0.42), (0.295, high - 0.4, 0.4),
        (0.27, high - 0.37, 0.4), (0.27, high - 0.22), (0.3, high - 0.15, 0.3),
        (0.3, high - 0.11), (0.325, high - 0.08, 0.2), (0.325, high), (0.2, high)])), y=WALK)


def colonnette(level: Level) -> Array:
    """On the balustrade, to the springing of the upper arches."""
    height = UPPER_SPRING - RAIL
    outline = level.outline([
        (0.135, 0.06), (0.135, 0.105, 0.5), (0.118, 0.125, -0.4), (0.118, 0.155, 0.5),
        (0.1, 0.165), (0.1, 0.55), (0.088, height - 0.34, 0.015), (0.103, height - 0.325, 0.5),
        (0.088, height - 0.31, 0.5), (0.09, height - 0.28), (0.135, height - 0.09, -0.22),
        (0.135, height - 0.07)])
    slab = level.outline([(0.13, height - 0.09), (0.155, height - 0.055, 0.3),
                          (0.165, height - 0.055), (0.165, height), (0.1, height)])
    foot = level.outline([(0.155, -0.02), (0.155, 0.06), (0.09, 0.06)])
    parts = [lathe(outline, level.segments(34, 4)), square(slab)]
    if level.has(0.02):
        parts.append(square(foot))
    if level.has(0.4):
        foliage = moved(leaf(level, 0.2, 0.06, 0.09), y=height - 0.3, z=0.088)
        parts.append(around(foliage, 4, PI / 4))
    return moved(joined(parts), y=RAIL)


def baluster(level: Level) -> Array:
    foot, top = GALLERY + 0.34, RAIL - 0.13
    belly = foot + 0.2
    return lathe(level.outline([
        (0.062, foot), (0.062, foot + 0.04), (0.04, foot + 0.055), (0.04, foot + 0.075),
        (0.07, belly, 0.12), (0.036, top - 0.13, -0.13), (0.034, top - 0.115),
        (0.05, top - 0.095, 0.5), (0.036, top - 0.075, 0.5), (0.036, top - 0.06),
        (0.058, top - 0.035, 0.2), (0.058, top)]), level.segments(15, 4))


def pedestal(level: Level) -> Array:
    """The part of the balustrade that carries a colonnette."""
    low, high = GALLERY + 0.2, RAIL + 0.015
    return square(level.outline([(0.175, low), (0.175, high - 0.16), (0.205, high - 0.12, 0.25),
                                 (0.205, high - 0.02), (0.19, high), (0.1, high)]))


def upper_pier(level: Level) -> Array:
    """The corner of the gallery."""
    low, high = GALLERY + 0.2, UPPER_SPRING
    if level.coarse:
        return square(np.array([(0.22, low), (0.22, high + 0.3)]))
    return square(level.outline([
        (0.22, low), (0.22, high - 0.3), (0.24, high - 0.28, 0.4), (0.22, high - 0.26, 0.4),
        (0.22, high - 0.14), (0.25, high - 0.05, 0.25), (0.255, high), (0.1, high)]))
