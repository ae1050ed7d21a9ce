# SPDX-License-Identifier: GPL-3.0-only
"""Grass, fallen leaves and mushrooms."""

import numpy as np

from model import vectors
from model.meshes import joined, repeated
from model.noise import gradient_noise
from model.portable import PI, Random, cos, power, sin
from model.shapes import lathe, spline

from . import land, leaves
from .branching import UP
from .scatter import scattered
from .species import BROAD

Array = np.ndarray


def fallen_leaves(triangles: float) -> Array:
    level = int(triangles > 2e4) + int(triangles > 1.2e5)
    blades = BROAD[level]
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
    joints = int(np.clip(2 * np.sqrt(np.sqrt(detail)), 1, 6))
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
    tall = (0.5 + 0.9 * draws[:, 2]) * (0.7 + 0.3 * np.sqrt(growth))
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
    segments = int(np.clip(28 * power(detail, 0.4), 4, 48))
    some = slice(None, None, max(1, int(0.02 / detail)))
    return repeated(mushroom(segments), (lean * size[:, np.newaxis, np.newaxis])[some],
                    land.on_ground(x, z)[some])
