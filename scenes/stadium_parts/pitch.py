# SPDX-License-Identifier: GPL-3.0-only
"""A football pitch in units of 1.3 m: turf, lines, goals, corner flags, boards and dugouts."""

import numpy as np

from model.meshes import joined, moved, rotated, X, Y
from model.portable import PI, cos, sin
from model.shapes import box, quad, steps, surface, tubes

from . import plan

Array = np.ndarray

METRE = 1 / 1.3
LENGTH, BREADTH = 105 * METRE, 68 * METRE
MARGIN = 1.6  # of turf outside the lines
BANDS = 20  # that the mower left; the grass of each leans the other way than that of its neighbours
RIDGES = 40  # of grass in each band
BLADE_HEIGHT = 0.05
LINE = 0.12
GROUND = -0.06
CIRCLE = 9.15 * METRE
GOAL_WIDTH, GOAL_HEIGHT, GOAL_DEPTH = 7.32 * METRE, 2.44 * METRE, 1.6
POST, CORD = 0.06, 0.008


def turf() -> Array:
    """Saw teeth across the pitch. Their gentle sides look to the end towards which the grass of a
    band leans."""
    half_length, half_breadth = LENGTH / 2 + MARGIN, BREADTH / 2 + MARGIN
    tooth = 2 * half_length / BANDS / RIDGES
    start = np.arange(BANDS * RIDGES) * tooth - half_length
    leans = np.arange(BANDS * RIDGES) // RIDGES % 2
    tip = start + tooth * np.where(leans, 0.2, 0.8)
    x = np.append(np.stack([start, tip], axis=-1).reshape(-1), half_length)
    y = np.append(np.tile([-BLADE_HEIGHT, 0.0], BANDS * RIDGES), -BLADE_HEIGHT)
    edges = [np.stack([x, y, np.full_like(x, z)], axis=-1) for z in (half_breadth, -half_breadth)]
    return surface(np.stack(edges, axis=1))


def flat_turf() -> Array:
    x, y, z = LENGTH / 2 + MARGIN, -BLADE_HEIGHT / 2, BREADTH / 2 + MARGIN
    return quad((-x, y, z), (x, y, z), (x, y, -z), (-x, y, -z))


def line(x: tuple[float, float], z: tuple[float, float], layer: int) -> Array:
    """A strip that covers the rectangle. Layers lie on each other, as lines that cross must not be
    in one plane."""
    return box((x[0], -BLADE_HEIGHT, z[0]), (x[1], 0.01 + 0.004 * layer, z[1]))


def rectangle_lines(x: tuple[float, float], z: tuple[float, float], layer: int) -> Array:
    """Along the border of a rectangle, on its inner side."""
    return joined(line((x[0], x[0] + LINE), z, layer), line((x[1] - LINE, x[1]), z, layer),
                  line(x, (z[0], z[0] + LINE), layer + 1), line(x, (z[1] - LINE, z[1]), layer + 1))


def arc_line(radius: float, start: float, end: float, layer: int, segments: int) -> Array:
    angle = start + np.arange(segments + 1) * ((end - start) / segments)
    top = 0.01 + 0.004 * layer
    profile = [(radius - LINE, -BLADE_HEIGHT), (radius - LINE, top), (radius, top),
               (radius, -BLADE_HEIGHT)]
    return surface(np.stack([np.stack([r * cos(angle), np.full_like(angle, y), r * sin(angle)], -1)
                             for r, y in profile], axis=1))


def end_lines(segments: int) -> Array:
    """Those of the half at positive x."""
    goal_line = LENGTH / 2
    spot = goal_line - 11 * METRE
    half_width, depth = 20.16 * METRE, 16.5 * METRE
    reach = 0.9259  # the arc ends where cos(reach) = 5.5 m / 9.15 m: at the area
    small_width, small_depth = 9.16 * METRE, 5.5 * METRE
    corner = moved(arc_line(1.0, PI, 1.5 * PI, 4, segments), x=goal_line, z=BREADTH / 2)
    mirror = np.array([1.0, 1.0, -1.0])
    return joined(
        rectangle_lines((goal_line - depth, goal_line + LINE / 2), (-half_width, half_width), 3),
        rectangle_lines((goal_line - small_depth, goal_line + LINE / 3),
                        (-small_width, small_width), 5),
        moved(arc_line(CIRCLE, PI - reach, PI + reach, 0, segments * 2), x=spot),
        line((spot - 0.12, spot + 0.12), (-0.12, 0.12), 0), corner, corner * mirror)


def lines(segments: int) -> Array:
    end = end_lines(segments)
    return joined(
        rectangle_lines((-LENGTH / 2, LENGTH / 2), (-BREADTH / 2, BREADTH / 2), 0),
        line((-LINE / 2, LINE / 2), (-BREADTH / 2, BREADTH / 2), 2),
        arc_line(CIRCLE, 0, 2 * PI, 0, segments * 8), end, end * np.array([-1.0, 1.0, 1.0]))


def net_cords(fineness: float) -> Array:
    """Paths over the net's roof and back, and others along its height, that sag a little."""
    count = steps(36 * fineness, 4)
    z = (np.arange(count + 1) / count - 0.5) * GOAL_WIDTH
    section = np.array([(0, GOAL_HEIGHT), (0.35, GOAL_HEIGHT - 0.05), (0.7, GOAL_HEIGHT - 0.03),
                        (1.1, 1.0), (1.45, 0.3), (GOAL_DEPTH, 0.0)])
    paths = np.stack(np.broadcast_arrays(section[:, 0], section[:, 1], z[:, np.newaxis]), axis=-1)
    rise = steps(14 * fineness, 2)
    t = np.arange(1, rise * 2) / (rise * 2) * (len(section) - 1)
    at = np.minimum(t.astype(np.int64), len(section) - 2)
    part = (t - at)[:, np.newaxis]
    profile = section[at] * (1 - part) + section[at + 1] * part
    across = np.array([-0.5, -0.25, 0, 0.25, 0.5]) * GOAL_WIDTH
    rows = np.stack(np.broadcast_arrays(profile[:, :1], profile[:, 1:], across), axis=-1)
    return joined(tubes(paths, CORD, 3, closed_ends=False), tubes(rows, CORD, 3, closed_ends=False))


def side_net(fineness: float) -> Array:
    """Upright and level cords in the plane of a side, up to the slope of the back."""
    count = steps(10 * fineness, 2)
    x = (np.arange(count) + 0.5) / count * GOAL_DEPTH
    top = np.where(x < 0.7, GOAL_HEIGHT - 0.03, (GOAL_DEPTH - x) / 0.9 * (GOAL_HEIGHT - 0.1))
    uprights = np.stack([np.stack([x, np.zeros(count), np.zeros(count)], -1),
                         np.stack([x, top, np.zeros(count)], -1)], axis=1)
    y = (np.arange(count) + 0.5) / count * GOAL_HEIGHT
    reach = GOAL_DEPTH - 0.9 * np.minimum(1, y / GOAL_HEIGHT)
    levels = np.stack([np.stack([np.zeros(count), y, np.zeros(count)], -1),
                       np.stack([reach, y, np.zeros(count)], -1)], axis=1)
    return tubes(np.concatenate([uprights, levels]), CORD, 3, closed_ends=False)


def goal(fineness: float) -> Array:
    """Its mouth in the plane x = 0, the net towards x."""
    half, sides = GOAL_WIDTH / 2 + POST, steps(10 * fineness, 4)
    top = GOAL_HEIGHT + POST
    frame = [[(0, -0.1, z), (0, top, z)] for z in (-half, half)] + [[(0, top, -half),
                                                                     (0, top, half)]]
    stays = [[(0, top, z), (0.7, top, z), (GOAL_DEPTH, 0, z)] for z in (-half, half)]
    base = [[(0, 0.02, -half), (GOAL_DEPTH, 0.02, -half), (GOAL_DEPTH, 0.02, half),
             (0, 0.02, half)]]
    return joined(tubes(frame, POST, sides), tubes(stays, 0.03, 5), tubes(base, 0.03, 5),
                  net_cords(fineness), *(moved(side_net(fineness), z=z) for z in (-half, half)))


def corner_flag() -> Array:
    pole = tubes([[(0, -0.1, 0), (0, 1.2, 0)]], 0.02, 6)
    cloth = np.array([[(0, 1.2, 0), (0.22, 1.12, 0.2), (0, 0.9, 0)]], dtype=float)
    return joined(pole, cloth)


def boards() -> Array:
    """Advertising boards along the sides and the ends, leaning back."""
    length, gap, height = 4.4, 0.15, 0.75
    panel = rotated(box((-length / 2, 0.04, -0.05), (length / 2, height, 0.05)), X, 0.2)
    count_x, count_z = int(LENGTH / (length + gap)), int(BREADTH / (length + gap))
    z, x = BREADTH / 2 + 2.7, LENGTH / 2 + 3.4
    meshes = []
    for i in range(count_x):
        place = (i - (count_x - 1) / 2) * (length + gap)
        meshes += [moved(panel, place, GROUND, -z), moved(rotated(panel, Y, PI), place, GROUND, z)]
    for i in range(count_z):
        place = (i - (count_z - 1) / 2) * (length + gap)
        meshes += [moved(rotated(panel, Y, PI / 2), -x, GROUND, place),
                   moved(rotated(panel, Y, -PI / 2), x, GROUND, place)]
    return joined(meshes)


def dugout(segments: int) -> Array:
    """A shelter for the substitutes, open towards -z, with a bench and ribs on its roof."""
    half, rib = 4.0, 0.05
    angle = np.arange(segments + 1) / segments * (0.62 * PI)
    z, y = 1.5 * cos(angle), 1.75 * sin(angle)
    shell = surface(np.stack([np.stack([np.full_like(z, x), y, z], axis=-1)
                              for x in (-half, half)], axis=1))
    places = np.arange(9) / 4 * half - half
    ribs = tubes(np.stack(np.broadcast_arrays(places[:, np.newaxis], y, z), axis=-1), rib, 5)
    ends = [np.array([((x, 0, 0), (x, b, a), (x, d, c)) for a, b, c, d
                      in zip(z[:-1], y[:-1], z[1:], y[1:])], dtype=float) for x in (-half, half)]
    bench = [box((-half + 0.1, 0.32, 0.55), (half - 0.1, 0.4, 1.0)),
             box((-half + 0.1, 0.5, 1.0), (half - 0.1, 0.85, 1.06))]
    bench += [box((x - 0.04, -0.05, 0.6), (x + 0.04, 0.34, 1.03)) for x in (-3.0, 0.0, 3.0)]
    return joined(shell, ribs, ends, bench)


def dugouts(segments: int) -> Array:
    """On both sides of the halfway line, in front of the sunny stand."""
    z = BREADTH / 2 + 4.6
    return joined(moved(dugout(segments), x, GROUND, z) for x in (-9.0, 9.0))


def ground(angles: Array) -> Array:
    """Out to the front wall."""
    edge = plan.at(angles, GROUND, 0.05)
    middle = np.broadcast_to(np.array([0, GROUND, 0]), edge.shape)
    return np.stack([middle, np.roll(edge, -1, axis=0), edge], axis=1)


def pitch(angles: Array, fineness: float) -> Array:
    """The ground reaches out to the front wall, which has corners at these angles."""
    parts = [ground(angles)]
    if fineness > 0.07:
        parts += [turf() if fineness > 0.1 else flat_turf(), lines(steps(12 * fineness, 3))]
    if fineness > 0.22:
        end = joined(moved(goal(fineness), x=LENGTH / 2),
                     moved(corner_flag(), LENGTH / 2, 0, BREADTH / 2),
                     moved(corner_flag(), LENGTH / 2, 0, -BREADTH / 2))
        parts += [end, end * np.array([-1.0, 1.0, 1.0]), boards(),
                  dugouts(steps(12 * fineness, 4))]
    return joined(parts)
