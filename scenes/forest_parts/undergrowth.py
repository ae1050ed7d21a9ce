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

Array = np.ndarray

WITHERED = (  # fallen leaves, pressed flat: coarse and fine
    [leaves.simple_blade(0.5, 0.3, 0.12), leaves.simple_blade(0.45, 0.34, -0.1)],
    [leaves.blade([(0.45, 0.3)], 0.12, 0.08), leaves.blade([(0.5, 0.34)], -0.08, -0.06),
     leaves.blade([(0.4, 0.27)], 0.18, -0.1)])
MUSHROOMS = [  # x, z, height
    (1.00, 36.10, 0.62), (0.62, 35.75, 0.44), (1.32, 35.80, 0.40), (0.90, 35.45, 0.30),
    (1.28, 36.45, 0.26), (0.50, 36.25, 0.27), (1.62, 36.15, 0.20), (0.05, 34.90, 0.42),
    (0.38, 34.70, 0.28), (-0.25, 34.55, 0.24), (1.50, 32.60, 0.42), (1.85, 32.40, 0.30),
    (1.45, 32.15, 0.25), (3.20, 27.60, 0.45), (2.90, 27.30, 0.35)]


def fallen_leaves(triangles: float) -> Array:
    blades = WITHERED[int(triangles > 2e4)]
    count = int(triangles / len(blades[0]))
    x, z, distance, draws = scattered(count, 2.5, 60, 401, 1.9)
    turn = 2 * PI * draws[:, 0]
    direction = np.stack([cos(turn), 0.2 * (draws[:, 1] - 0.5), sin(turn)], axis=-1)
    upper = UP + 0.22 * (draws[:, 2:5] * 2 - 1)
    growth = min(4.0, np.sqrt(max(1.0, 40000 / max(1, count))))
    size = 0.15 * (0.6 + 0.7 * draws[:, 5]) * (1 + distance / 30) * growth
    lift = (0.02 + 0.03 * draws[:, 3])[:, np.newaxis] * UP
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
    """Cap and foot, a unit high."""
    cap = spline(np.array([(0.07, 0.60), (0.30, 0.56), (0.42, 0.53), (0.42, 0.60), (0.34, 0.80),
                           (0.18, 0.96), (0.0, 1.0)]), max(6, segments // 2))
    cap[-1, 0] = 0
    foot = np.array([(0.13, -0.3), (0.10, 0.1), (0.075, 0.40), (0.07, 0.62)])
    return joined(lathe(cap, segments), lathe(foot, max(4, segments // 2)))


def mushrooms(detail: float) -> Array:
    random = Random(431)
    x, z, size = np.array(MUSHROOMS).T
    angle = random.uniform(0, 2 * PI, len(x))
    axis = np.stack([cos(angle), np.zeros(len(x)), sin(angle)], axis=-1)
    lean = vectors.rotation(axis, random.uniform(0, 0.25, len(x)))
    segments = int(np.clip(40 * power(detail, 0.4), 4, 64))
    some = slice(None, None, max(1, int(0.02 / detail)))
    return repeated(mushroom(segments), (lean * size[:, np.newaxis, np.newaxis])[some],
                    land.on_ground(x, z)[some])
