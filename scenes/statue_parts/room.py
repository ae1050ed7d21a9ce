# SPDX-License-Identifier: GPL-3.0-only
"""A hall with a niche in its end wall, which is the plane z = 0. Lengths are in 100 mm."""

import numpy as np

from model.meshes import joined, moved, rotated, Y
from model.portable import PI, Random, cos, sin, smoothstep
from model.shapes import box, circle, extruded, lathe, polygon, quad, steps, surface

from .mouldings import around_pilaster, panel_frame, profile, straight

Array = np.ndarray

HALF_WIDTH, HEIGHT, DEPTH = 22.0, 44.0, 50.0
NICHE_RADIUS, NICHE_FLOOR, SPRINGLINE = 7.2, 1.6, 21.6
FLUTES = 13  # of the shell
PILASTER_X, PILASTER_HALF, PILASTER_DEPTH = 10.6, 1.3, 0.7
PILASTER_FOOT, PILASTER_TOP = 4.2, 28.2
ENTABLATURE = 29.6
WINDOW_Y, WINDOW_Z, REVEAL = (20.0, 41.0), (8.0, 26.0), 0.6
PANE_DISTANCE = 2.0  # from the reveal: a light that touched it would make noise
TILE, JOINT = 3.6, 0.14
PLAIN = 0.002  # level of detail below which there are neither flutes nor dentils
BAY = 16.9  # the middle between a pilaster and a side wall


def window() -> Array:
    """A bright sky outside the window in the left wall."""
    x, (y0, y1), (z0, z1) = -HALF_WIDTH - REVEAL - PANE_DISTANCE, WINDOW_Y, WINDOW_Z
    y0, y1, z0, z1 = y0, y1 + 2, z0 - 1, z1 + 1
    return quad((x, y0, z1), (x, y0, z0), (x, y1, z0), (x, y1, z1))


def room(detail: float) -> Array:
    return joined(_shell(detail), _niche(detail), _archivolt(detail), _pilasters(detail),
                  _entablature(detail), _panels(detail), _steps(detail), _floor(detail),
                  _vases(detail))


def _shell(detail: float) -> list[Array]:
    """Walls, ceiling and reveal of the window; the end wall leaves out the niche."""
    w, h, d = HALF_WIDTH, HEIGHT, DEPTH
    arch = _arch_points(detail)[:, :2]
    x, y = arch[:, 0], arch[:, 1]
    upper = np.abs(x) < 0.75 * NICHE_RADIUS  # some of these points meet in the corners
    spread = np.clip(x * (w / NICHE_RADIUS / 0.65), -w, w)
    outer = np.stack([np.where(upper, spread, np.where(x > 0, w, -w)), np.where(upper, h, y)],
                     axis=-1)
    flat = [np.concatenate([points, np.zeros((len(points), 1))], axis=1)
            for points in (arch, outer)]
    r, spring = NICHE_RADIUS, SPRINGLINE
    end = [quad((-w, 0, 0), (-r, 0, 0), (-r, spring, 0), (-w, spring, 0)),
           quad((r, 0, 0), (w, 0, 0), (w, spring, 0), (r, spring, 0)),
           surface(np.stack(flat, axis=1)[::-1])]
    (y0, y1), (z0, z1), x = WINDOW_Y, WINDOW_Z, -w - REVEAL
    left = [quad((-w, 0, d), (-w, 0, 0), (-w, y0, 0), (-w, y0, d)),
            quad((-w, y1, d), (-w, y1, 0), (-w, h, 0), (-w, h, d)),
            quad((-w, y0, z0), (-w, y0, 0), (-w, y1, 0), (-w, y1, z0)),
            quad((-w, y0, d), (-w, y0, z1), (-w, y1, z1), (-w, y1, d)),
            quad((x, y0, z1), (-w, y0, z1), (-w, y0, z0), (x, y0, z0)),
            quad((x, y1, z0), (-w, y1, z0), (-w, y1, z1), (x, y1, z1)),
            quad((x, y0, z0), (-w, y0, z0), (-w, y1, z0), (x, y1, z0)),
            quad((x, y1, z1), (-w, y1, z1), (-w, y0, z1), (x, y0, z1))]
    others = [quad((w, 0, 0), (w, 0, d), (w, h, d), (w, h, 0)),
              quad((w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d)),
              quad((-w, h, 0), (w, h, 0), (w, h, d), (-w, h, d))]
    return end + left + others


def _arch_points(detail: float) -> Array:
    """The rim of the niche's semidome from right to left, with the directions of its radii."""
    count = FLUTES * steps(10 * np.sqrt(detail), 1) if detail > PLAIN else 8
    turn = np.arange(count + 1) * (PI / count)
    direction = np.stack([cos(turn), sin(turn)], axis=-1)
    return np.concatenate([direction * NICHE_RADIUS + np.array([0, SPRINGLINE]), direction], axis=1)


def _niche(detail: float) -> list[Array]:
    rim = _arch_points(detail)[:, 2:]
    foot = np.stack([rim[:, 0] * NICHE_RADIUS, np.full(len(rim), NICHE_FLOOR - 0.1),
                     -rim[:, 1] * NICHE_RADIUS], axis=-1)
    wall = np.stack([foot, foot + np.array([0, SPRINGLINE - NICHE_FLOOR + 0.1, 0])], axis=1)
    return [surface(wall), _semidome(rim, detail), _impost(detail)]


def _semidome(rim: Array, detail: float) -> Array:
    """A shell, whose flutes fan out from the back of the niche."""
    count = steps(70 * np.sqrt(detail), 2)
    polar = np.arange(count + 1) * (PI / 2 / count)
    flute = np.arange(len(rim)) * (FLUTES / (len(rim) - 1))
    groove = 2 * np.abs(flute - np.floor(flute) - 0.5)
    hollow = np.sqrt(1 - groove * groove * groove)
    fading = smoothstep(0.02, 0.2, polar) * smoothstep(1, 0.94, polar / (PI / 2))
    depth = 0.7 * sin(polar) * fading
    radius = NICHE_RADIUS + depth * hollow[:, np.newaxis]
    x = radius * sin(polar) * rim[:, :1]
    y = radius * sin(polar) * rim[:, 1:]
    return moved(surface(np.stack([x, y, -radius * cos(polar)], axis=-1)), y=SPRINGLINE)


def _impost(detail: float) -> Array:
    """The moulding inside the niche at the foot of the semidome."""
    section = profile([(0.1, -0.9), (-0.12, -0.9), (-0.12, -0.65), (-0.2, -0.62),
                       (-0.5, -0.25, -0.3), (-0.5, 0.0), (0.1, 0.05)], detail)
    rim = _arch_points(detail)[:, 2:]
    radius = NICHE_RADIUS + section[:, 0]
    height = np.broadcast_to(section[:, 1], (len(rim), len(section)))
    ring = np.stack([rim[:, :1] * radius, height + SPRINGLINE, -rim[:, 1:] * radius], axis=-1)
    return joined(surface(ring), polygon(ring[0]), polygon(ring[-1, ::-1]))


def _archivolt(detail: float) -> list[Array]:
    """The moulded frame of the niche, and the keystone."""
    section = profile([(-0.02, -0.05), (-0.02, 0.25), (0.12, 0.25), (0.3, 0.42, -0.4), (0.62, 0.42),
                       (0.62, 0.34), (0.95, 0.34), (1.15, 0.6, 0.5), (1.35, 0.6), (1.35, -0.05)],
                      detail)
    rim = _arch_points(detail)
    jambs = [np.array([[side, 0, 0, NICHE_FLOOR - 0.1]]) for side in (1.0, -1.0)]
    arc = np.stack([rim[:, 2], rim[:, 3], rim[:, 2] * 0, rim[:, 2] * 0 + SPRINGLINE], axis=1)
    path = np.concatenate([jambs[0], arc, jambs[1]])
    radius = NICHE_RADIUS + section[:, 0]
    points = np.stack([path[:, :1] * radius, path[:, 1:2] * radius + path[:, 3:],
                       np.broadcast_to(section[:, 1], (len(path), len(section)))], axis=-1)
    top = SPRINGLINE + NICHE_RADIUS
    key = [(-0.75, top - 0.35, -0.05), (0.75, top - 0.35, -0.05), (1.15, top + 1.7, -0.05),
           (-1.15, top + 1.7, -0.05)]
    face = [(-0.5, top - 0.1, 0.75), (0.5, top - 0.1, 0.75), (0.85, top + 1.45, 0.75),
            (-0.85, top + 1.45, 0.75)]
    return [surface(points), extruded(key, (0, 0, 0.85)), extruded(face, (0, 0, 0.35))]


def _pilasters(detail: float) -> list[Array]:
    base = profile([(0.45, 0.7), (0.45, 1.9), (0.4, 2.0), (0.42, 2.6, 0.9), (0.22, 2.65),
                    (0.22, 3.15, -0.5), (0.28, 3.2), (0.28, 3.6, 0.9), (0.12, 3.65),
                    (0, PILASTER_FOOT, -0.4)], detail)
    capital = profile([(0, PILASTER_TOP - 1.6), (0.14, PILASTER_TOP - 1.5, 0.9),
                       (0, PILASTER_TOP - 1.35), (0.02, PILASTER_TOP - 0.6),
                       (0.45, PILASTER_TOP, 0.4), (0.6, PILASTER_TOP + 0.05),
                       (0.6, PILASTER_TOP + 0.6), (0.75, PILASTER_TOP + 0.7, 0.3),
                       (0.75, PILASTER_TOP + 0.95), (0, PILASTER_TOP + 0.95)], detail)
    plinth = box((-PILASTER_HALF - 0.6, -0.1, -0.05),
                 (PILASTER_HALF + 0.6, 0.75, PILASTER_DEPTH + 0.6))
    one = joined(plinth, _fluted_shaft(detail),
                 *(around_pilaster(section, PILASTER_HALF, PILASTER_DEPTH)
                   for section in (base, capital)))
    return [moved(one, x=x) for x in (-PILASTER_X, PILASTER_X)]


def _fluted_shaft(detail: float) -> Array:
    count = steps(10 * np.sqrt(detail), 1)
    x, z = [-PILASTER_HALF, -PILASTER_HALF], [-0.05, PILASTER_DEPTH]
    pitch = 2 * PILASTER_HALF / 5
    turn = np.arange(count + 1) * (PI / count)
    for i in range(5 if detail > PLAIN else 0):
        middle = -PILASTER_HALF + (i + 0.5) * pitch
        x.extend(middle - 0.37 * pitch * cos(turn))
        z.extend(PILASTER_DEPTH - 0.37 * pitch * sin(turn))
    x, z = np.array(x + [PILASTER_HALF] * 2), np.array(z + [PILASTER_DEPTH, -0.05])
    ends = [np.stack([x, np.full_like(x, y), z], axis=-1)
            for y in (PILASTER_FOOT - 0.1, PILASTER_TOP - 1.55)]
    return surface(np.stack(ends, axis=1))


def _entablature(detail: float) -> list[Array]:
    y = ENTABLATURE
    section = profile([(-0.05, y - 0.35), (0.75, y - 0.35), (0.75, y + 0.25), (0.85, y + 0.25),
                       (0.85, y + 0.9), (1.0, y + 1.05, 0.4), (1.0, y + 1.15), (0.8, y + 1.15),
                       (0.8, y + 2.6), (0.95, y + 2.8, -0.4), (0.95, y + 3.3), (1.6, y + 3.3),
                       (1.6, y + 3.35), (1.9, y + 3.6, 0.4), (1.9, y + 4.0), (2.0, y + 4.05),
                       (2.4, y + 4.7, -0.5), (2.4, y + 4.9), (-0.05, y + 5.1)], detail)
    count = steps(56 * np.sqrt(np.sqrt(detail)), 8)
    pitch = 2 * HALF_WIDTH / count
    dentil = box((-0.3 * pitch, y + 2.85, 0.9), (0.3 * pitch, y + 3.25, 1.5))
    dentils = [moved(dentil, x=-HALF_WIDTH + (i + 0.5) * pitch)
               for i in range(count if detail > PLAIN else 0)]
    return [straight(section, -HALF_WIDTH, HALF_WIDTH)] + dentils


def _panels(detail: float) -> list[Array]:
    """Framed panels in the bays beside the pilasters and on the side walls."""
    section = profile([(0, -0.05), (0, 0.2), (0.12, 0.32, 0.4), (0.3, 0.32), (0.5, 0.12, -0.5),
                       (0.55, 0.12), (0.55, -0.05)], detail)
    bay = panel_frame(section, (-2.7, 4.6), (2.7, 26.6))
    side = panel_frame(section, (-5.0, 2.6), (5.0, 14.0))
    walls = [moved(rotated(side, Y, turn * PI / 2), x=-turn * HALF_WIDTH, z=z)
             for turn in (1, -1) for z in (8, 20, 32)]
    return [moved(bay, x=x) for x in (-BAY, BAY)] + walls


def _steps(detail: float) -> list[Array]:
    """Two round steps before the niche; the upper one is its floor."""
    segments = steps(160 * np.sqrt(detail), 10)
    return [lathe(profile([(radius - 0.2, y - 0.9), (radius - 0.2, y - 0.35),
                           (radius - 0.1, y - 0.3), (radius - 0.1, y, 1.0), (0, y)], detail),
                  segments) for radius, y in ((11.6, 0.8), (9.6, NICHE_FLOOR))]


def _floor(detail: float) -> list[Array]:
    """Tiles with bevelled edges, none quite as high as the next, on a plane."""
    size = TILE * max(1, int(np.sqrt(np.sqrt(1 / detail))))
    random = Random(5)
    across, along = (steps(length / size, 1) for length in (2 * HALF_WIDTH, DEPTH))
    half = np.array([HALF_WIDTH / across, DEPTH / along / 2]) - JOINT / 2
    top, rim = half - 0.1, half
    tile = []
    for (sx, sz), (tx, tz) in zip(((-1, 1), (1, 1), (1, -1), (-1, -1)),
                                  ((1, 1), (1, -1), (-1, -1), (-1, 1))):
        a, b = ((x * rim[0], -0.09, z * rim[1]) for x, z in ((sx, sz), (tx, tz)))
        c, d = ((x * top[0], 0, z * top[1]) for x, z in ((tx, tz), (sx, sz)))
        tile.append(quad(a, b, c, d))
    tile.append(quad(*((x * top[0], 0, z * top[1])
                       for x, z in ((-1, 1), (1, 1), (1, -1), (-1, -1)))))
    tile = joined(tile)
    sunk = random.uniform(-0.05, 0, (across, along))
    tiles = [moved(tile, (2 * i + 1 - across) * HALF_WIDTH / across, sunk[i, j],
                   (j + 0.5) * DEPTH / along) for i in range(across) for j in range(along)]
    w, d = HALF_WIDTH, DEPTH
    return tiles + [quad((-w, -0.1, d), (w, -0.1, d), (w, -0.1, 0), (-w, -0.1, 0))]


def pedestal(height: float, detail: float) -> list[Array]:
    """Round and fluted, on a stepped base; it stands at the height 0."""
    segments = 12 * steps(16 * np.sqrt(detail), 1)
    base = profile([(5.3, -0.1), (5.3, 0.6), (5.0, 0.65), (5.0, 1.25, 0.95), (4.65, 1.3),
                    (4.4, 1.7, -0.5), (4.45, 1.75), (4.45, 2.05, 0.9), (4.2, 2.1),
                    (3.95, 2.4, -0.4)], detail)
    top = profile([(3.85, height - 1.9), (4.05, height - 1.7, 0.9), (3.85, height - 1.5),
                   (3.9, height - 1.3), (4.7, height - 0.75, 0.45), (5.0, height - 0.7),
                   (5.0, height - 0.15), (4.85, height), (0, height)], detail)
    return [lathe(base, segments), lathe(top, segments), _drum(3.95, 2.3, height - 1.8, segments)]


def _drum(radius: float, bottom: float, top: float, segments: int) -> Array:
    flute = np.arange(segments) * (24 / segments)
    groove = 2 * np.abs(flute - np.floor(flute) - 0.5)
    deep = 0.17 * np.sqrt(np.maximum(0, 1 - groove * groove * 1.25))
    ring = (circle(segments) * (radius - deep)[:, np.newaxis])[::-1]
    heights = np.array([bottom, top])
    points = [np.stack([ring[:, 0], np.full(segments, y), ring[:, 1]], axis=-1) for y in heights]
    return surface(np.stack(points, axis=1), closed_u=True)


def _vases(detail: float) -> list[Array]:
    """Two different vases on plinths in the bays."""
    segments = steps(120 * np.sqrt(detail), 6)
    krater = profile([(1.1, 0), (1.1, 0.2), (0.55, 0.7, -0.4), (0.5, 0.95), (0.62, 1.05, 0.9),
                      (0.5, 1.15), (1.7, 2.6, 0.35), (1.85, 3.4, 0.15), (1.6, 4.6, -0.25),
                      (2.15, 5.2, -0.25), (2.2, 5.35, 0.6), (1.95, 5.35), (1.3, 4.6), (0, 4.4)],
                     detail)
    amphora = profile([(0.9, 0), (0.9, 0.2), (0.5, 0.6, -0.4), (1.75, 3.3, 0.3), (1.35, 4.9, 0.35),
                       (0.62, 5.5, -0.25), (0.58, 6.4, -0.1), (0.95, 6.75, -0.3), (0.95, 6.95),
                       (0.75, 6.95), (0.5, 6.2), (0, 6.1)], detail)
    plinth = joined(box((-2.2, -0.1, -2.2), (2.2, 0.9, 2.2)),
                    box((-1.8, 0.8, -1.8), (1.8, 5.6, 1.8)),
                    box((-2.1, 5.5, -2.1), (2.1, 6.2, 2.1)))
    return [moved(joined(plinth, moved(lathe(vase, segments), y=6.15)), x=x, z=3.4)
            for vase, x in ((krater, -BAY), (amphora, BAY))]
