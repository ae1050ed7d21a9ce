# SPDX-License-Identifier: GPL-3.0-only
"""Ferns, grass, fallen leaves and mushrooms."""

import numpy as np

from model import vectors
from model.meshes import joined, repeated
from model.noise import gradient_noise
from model.portable import PI, Random, cos, power, sin
from model.shapes import lathe, spline, tubes

from . import land, leaves, trees
from .branching import UP

Array = np.ndarray

VIEW_HALF_ANGLE = 0.75  # radians; most of what is small grows where the camera looks


def frond(pairs: int, pinnules: int, length: float, rise: float, random: Random) -> Array:
    """A fern's leaf that springs from the origin and arches towards +x."""
    n = 24
    share = (np.arange(n) + 0.5) / n
    elevation = rise - (rise + 0.75) * power(share, 1.5)
    side_bend = 0.35 * float(random.uniform(-1, 1)) * share * share
    step = length / n * np.stack([cos(elevation) * cos(side_bend), sin(elevation),
                                  cos(elevation) * sin(side_bend)], axis=-1)
    rachis = np.concatenate([np.zeros((1, 3)), np.cumsum(step, axis=0)])
    at = 0.16 + 0.83 * (np.arange(pairs) + 0.5) / pairs
    place = at * n
    span = np.minimum(place.astype(np.int64), n - 1)
    base = rachis[span] + (place - span)[:, np.newaxis] * step[span]
    along = vectors.normalized(step)[span]
    aside = vectors.normalized(vectors.cross(along, UP))
    reach = length * 0.27 * np.minimum(1, 0.45 + 3 * (at - 0.16)) * power(1.02 - at, 0.75)
    parts = [tubes(rachis[::6][np.newaxis], 0.03 * (1.1 - np.arange(5) / 4), 3, False)]
    for side in (-1, 1):
        jitter = 0.12 * (random.uniform(0, 1, (pairs, 3)) * 2 - 1)
        direction = vectors.normalized(side * aside + 0.35 * along - 0.15 * UP + jitter)
        upper = vectors.cross(aside, along)
        parts.append(pinnae(base, direction, upper, reach, 1.5 * length / pairs, pinnules))
    return joined(parts)


def pinnae(base: Array, direction: Array, upper: Array, reach: Array, width: float,
           pinnules: int) -> Array:
    """Leaflets of a frond: simple ones, or pinnate once more."""
    if pinnules < 2:
        blade = [leaves.blade([(0.3, 0.25)], 0.25, 0.15)]
        matrices = leaves.frames(direction, upper, reach, np.minimum(reach, 0.75 * width))
        return leaves.strewn(blade, matrices, base)
    at = (np.arange(pinnules) + 0.4) / pinnules
    aside = vectors.normalized(vectors.cross(upper, direction))
    droop = 0.15 * at * at
    place = (base[:, np.newaxis] + reach[:, np.newaxis, np.newaxis] * (
        at[:, np.newaxis] * direction[:, np.newaxis] - droop[:, np.newaxis] * UP)).reshape(-1, 3)
    size = (reach[:, np.newaxis] * 0 + 0.55 * width * (1.05 - at)).reshape(-1)
    broad = np.repeat(reach, pinnules) / pinnules * 1.1
    blade = [leaves.simple_blade(0.4, 0.5, 0.3)]
    out = np.repeat(direction, pinnules, axis=0)
    meshes = []
    for side in (-1, 1):
        turned = side * np.repeat(aside, pinnules, axis=0) + 0.45 * out
        frame = leaves.frames(turned, np.repeat(upper, pinnules, axis=0), size,
                              np.minimum(broad, size))
        meshes.append(leaves.strewn(blade, frame, place))
    tip = leaves.frames(direction, upper, reach * 0.12, np.minimum(reach * 0.12, 0.06))
    meshes.append(leaves.strewn(blade, tip, base + reach[:, np.newaxis] * 0.97 * direction
                                - 0.15 * reach[:, np.newaxis] * UP))
    return joined(meshes)


def fern(fronds: int, pairs: int, pinnules: int, seed: int) -> Array:
    """A shuttlecock of fronds about the origin."""
    random = Random(300 + seed)
    meshes = []
    for i in range(fronds):
        length = 2.0 + 0.7 * float(random.uniform(-1, 1))
        rise = 1.15 + 0.25 * float(random.uniform(-1, 1))
        turn = 2 * PI * i / fronds + 0.5 * float(random.uniform(-1, 1))
        meshes.append(vectors.transformed(frond(pairs, pinnules, length, rise, random),
                                          vectors.rotation(UP, turn)))
    return joined(meshes)


def ferns(triangles: float) -> Array:
    """In three belts about the eye, the nearest with leaflets of their own."""
    meshes = []
    for belt, (near, far, count, share) in enumerate(((4.5, 16, 28, 0.62), (14, 34, 80, 0.24),
                                                      (30, 62, 120, 0.14))):
        x, z, _, draws = scattered(14 * count, near, far, 420 + belt, 0.9)
        groups = gradient_noise(np.stack([x / 9, 0 * x, z / 9], -1), 423)
        kept = (land.beside_path(x, z) > 2.9) & ~land.under_log(x, z) & (groups > -0.25 + 0.3 * draws[:, 0])
        count = int(min(count, max(3, share * triangles / 60)))
        kept &= np.cumsum(kept) <= count
        each = share * triangles / count
        kinds = [fern(*_leaflets(each, kind), seed=3 * belt + kind) for kind in range(3)]
        size = 0.75 + 0.6 * draws[kept, 1]
        matrices = vectors.rotation(UP, 2 * PI * draws[kept, 2]) * size[:, np.newaxis, np.newaxis]
        meshes.append(leaves.strewn(kinds, matrices, land.on_ground(x[kept], z[kept])))
    return joined(meshes)


def _leaflets(triangles: float, kind: int) -> tuple[int, int, int]:
    """Fronds, pairs of leaflets, and their own pairs of leaflets, of a fern of so many triangles."""
    fronds = int(min(8 + kind, max(3, triangles / 40)))
    of_frond = triangles / fronds
    if of_frond < 26 * 8 * 6:
        return fronds, int(min(26, max(3, of_frond / 8))), 1
    return fronds, 26, int(min(30, of_frond / (26 * 8)))


def scattered(count: int, nearest: float, farthest: float, seed: int, towards: float = 1.4
              ) -> tuple[Array, Array, Array, Array]:
    """Places in view of the eye, denser near it: x, z, distance, and further draws (count, 6)."""
    draws = Random(seed).uniform(0, 1, (count, 8))
    distance = nearest + (farthest - nearest) * power(draws[:, 0], towards)
    angle = VIEW_HALF_ANGLE * (2 * draws[:, 1] - 1)
    x = land.EYE[0] + distance * sin(angle)
    z = land.EYE[1] - distance * cos(angle)
    inside = x * x + z * z < (land.RADIUS - 4)**2
    return x[inside], z[inside], distance[inside], draws[inside, 2:]


def fallen_leaves(triangles: float) -> Array:
    level = int(triangles > 2e4) + int(triangles > 1.2e5)
    blades = trees.BROAD[level]
    count = int(triangles / len(blades[0]))
    x, z, distance, draws = scattered(count, 2.5, 60, 401, 1.9)
    turn = 2 * PI * draws[:, 0]
    direction = np.stack([cos(turn), 0.3 * (draws[:, 1] - 0.5), sin(turn)], axis=-1)
    upper = UP + 0.45 * (draws[:, 2:5] * 2 - 1)
    growth = min(4.0, np.sqrt(max(1.0, 24000 / max(1, count))))
    size = 0.19 * (0.6 + 0.7 * draws[:, 5]) * (1 + distance / 30) * growth
    lift = (0.03 + 0.06 * draws[:, 3])[:, np.newaxis] * UP
    return leaves.strewn(blades, leaves.frames(direction, upper, size, size),
                         land.on_ground(x, z) + lift)


def grass(triangles: float, detail: float) -> Array:
    """Blades in tufts that leave the path free."""
    joints = int(np.clip(2 * detail**0.25, 1, 6))
    count = int(triangles / (2 * joints - 1))
    x, z, distance, draws = scattered(2 * count, 4, 62, 409, 1.6)
    tufts = gradient_noise(np.stack([x / 2.6, 0 * x, z / 2.6], -1), 411)
    meadow = gradient_noise(np.stack([x / 11, 0 * x, z / 11], -1) + 0.5, 412)
    beside = land.beside_path(x, z)
    kept = (tufts + 0.9 * meadow + 0.25 * draws[:, 0] > 0.3) & (beside > 1.7 + 0.8 * draws[:, 1])
    kept &= ~land.under_log(x, z)
    kept &= np.cumsum(kept) <= count
    x, z, distance, draws = x[kept], z[kept], distance[kept], draws[kept]
    growth = min(8.0, np.sqrt(max(1.0, 60000 / max(1, count))))
    tall = (0.5 + 0.9 * draws[:, 2]) * (0.7 + 0.3 * growth**0.5)
    turn = 2 * PI * draws[:, 3]
    lean = np.stack([cos(turn), np.zeros_like(turn), sin(turn)], axis=-1)
    t = (np.arange(joints + 1) / joints)[:, np.newaxis]
    bend = (0.2 + 0.7 * draws[:, 4])[:, np.newaxis, np.newaxis] * tall[:, np.newaxis, np.newaxis]
    center = (land.on_ground(x, z)[:, np.newaxis] - 0.05 * UP
              + tall[:, np.newaxis, np.newaxis] * (t - 0.25 * t * t) * UP
              + bend * t * t * lean[:, np.newaxis])
    half = (0.018 * (1 + distance / 25) * growth)[:, np.newaxis, np.newaxis] * (1 - t)
    across = vectors.cross(lean, UP)[:, np.newaxis]
    left, right = center - half * across, center + half * across
    below = np.stack([left[:, :-1], right[:, :-1], left[:, 1:]], axis=2).reshape(-1, 3, 3)
    above = np.stack([right[:, :-2], right[:, 1:-1], left[:, 1:-1]], axis=2).reshape(-1, 3, 3)
    return np.concatenate([below, above])


def mushroom(segments: int) -> Array:
    """Cap and stem, a unit high."""
    cap = spline(np.array([(0.10, 0.66), (0.40, 0.60), (0.52, 0.58), (0.50, 0.68), (0.36, 0.88),
                           (0.16, 0.98), (0.0, 1.0)]), max(5, segments // 2))
    cap[-1, 0] = 0
    foot = np.array([(0.15, -0.3), (0.12, 0.1), (0.10, 0.68)])
    return joined(lathe(cap, segments), lathe(foot, max(4, segments // 2)))


def mushrooms(detail: float) -> Array:
    """Groups of them: x, z, radius of the group, number."""
    groups = [(0.9, 35.7, 0.45, 9), (0.2, 34.6, 0.4, 7), (3.2, 26.6, 0.5, 6), (1.5, 32.0, 0.3, 5)]
    random = Random(431)
    x, z, size = (np.concatenate(values) for values in zip(*(
        (x + spread * random.normal(count), z + spread * random.normal(count),
         random.uniform(0.16, 0.42, count)) for x, z, spread, count in groups)))
    angle = random.uniform(0, 2 * PI, len(x))
    axis = np.stack([cos(angle), np.zeros(len(x)), sin(angle)], axis=-1)
    lean = vectors.rotation(axis, random.uniform(0, 0.3, len(x)))
    segments = int(np.clip(28 * detail**0.4, 4, 48))
    return repeated(mushroom(segments), lean * size[:, np.newaxis, np.newaxis],
                    land.on_ground(x, z))
