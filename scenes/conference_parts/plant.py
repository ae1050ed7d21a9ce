# SPDX-License-Identifier: GPL-3.0-only
"""A rubber plant in a tall pot: stems with large leaves around them."""

import numpy as np

from model import vectors
from model.meshes import X, Y, Z, joined
from model.portable import PI, Random, cos, power, sin
from model.shapes import lathe, spline, steps, surface

from .basics import COARSE, bar

Array = np.ndarray
POT_HEIGHT = 4.6
GOLDEN_ANGLE = PI * (3 - float(np.sqrt(5.0)))
STEM_POINTS = 5


def pot(fine: float) -> Array:
    """Conical, with a thick rim, filled with earth."""
    profile = [(0, 0.02), (1.45, 0.02), (1.5, 0.08), (2.1, POT_HEIGHT - 0.06), (2.06, POT_HEIGHT),
               (1.9, POT_HEIGHT), (1.86, POT_HEIGHT - 0.06), (1.84, POT_HEIGHT - 0.5),
               (0, POT_HEIGHT - 0.35)]
    return lathe(profile if fine > COARSE else profile[1:4:2] + profile[8:], steps(64 * fine, 5))


def stems(random: Random, count: int, height: float) -> Array:
    """Paths (count, STEM_POINTS, 3) that rise from the pot and spread."""
    t = np.arange(STEM_POINTS) / (STEM_POINTS - 1)
    angle = np.arange(count) * GOLDEN_ANGLE + random.uniform(-0.3, 0.3, count)
    spread = random.uniform(0.14, 0.3, count) * height
    rise = random.uniform(0.7, 1.0, count) * height
    sway = random.uniform(-0.25, 0.25, (count, STEM_POINTS))
    out = 0.5 + spread[:, np.newaxis] * t * t + sway * t
    return np.stack([out * cos(angle)[:, np.newaxis], POT_HEIGHT - 0.6 + rise[:, np.newaxis] * t,
                     out * sin(angle)[:, np.newaxis]], axis=-1)


def leaf(droop: float, along: int, across: int) -> Array:
    """Of length 1 along +z, folded along its midrib, pointed, drooping."""
    t = np.arange(along + 1) / along
    side = (np.arange(across + 1) / across * 2 - 1)
    outline = 0.24 * power(sin(PI * power(t, 0.75)), 0.8)
    outline[0] = 0.012
    outline[-1] = 0.0
    bend = droop * t
    z, y = t * (1 - 0.25 * droop * t), -0.45 * droop * t * t
    x = outline[:, np.newaxis] * side
    fold = 0.35 * np.abs(x) + 0.02 * sin(9 * t)[:, np.newaxis] * side * side
    y = y[:, np.newaxis] + fold * cos(bend)[:, np.newaxis]
    z = z[:, np.newaxis] + fold * sin(bend)[:, np.newaxis]
    return surface(np.stack([x, y, z], axis=-1)[::-1])


def leaves(paths: Array, count: int, random: Random, fine: float) -> Array:
    """Spiral around each stem; those near the tip are smaller and stand up."""
    fewer = min(1, 3 * fine)
    count = steps(count * fewer, 4)
    t = np.arange(count) / (count - 1)
    along, across = steps(16 * fine, 2), 2 * steps(5 * fine, 1) if fine > COARSE else 1
    kinds = [leaf(droop, along, across) for droop in (0.3, 0.7, 1.1, 1.5)]
    meshes = []
    nodes = np.rint((0.22 + 0.78 * t) * (8 * count - 1)).astype(np.int64)
    for path in paths:
        foot = spline(path, 8 * count)[nodes]
        turn = np.arange(count) * GOLDEN_ANGLE + random.uniform(-0.4, 0.4, count)
        rise = -0.15 + 1.05 * t * t + random.uniform(-0.2, 0.2, count)
        length = (3.4 - 1.5 * t) * random.uniform(0.8, 1.15, count) / np.sqrt(fewer)
        kind = random.integers(len(kinds), count)
        roll = random.uniform(-0.35, 0.35, count)
        for i in range(count):
            meshes.append(hung(kinds[kind[i]] * length[i], foot[i], turn[i], rise[i], roll[i]))
    return joined(meshes)


def hung(blade: Array, foot: Array, turn: float, rise: float, roll: float) -> Array:
    """At a stem, a short stalk away."""
    matrix = vectors.rotation(np.stack([Z, -X, Y]), np.array([roll, rise, turn]))
    mesh = vectors.transformed(blade, matrix[0]) + [0, 0, 0.25]
    for i in (1, 2):
        mesh = vectors.transformed(mesh, matrix[i])
    return mesh + foot


def plant(height: float, stem_count: int, leaves_each: int, fine: float, seed: int) -> Array:
    random = Random(seed)
    if fine < COARSE:
        stem_count = 2
    paths = stems(random, stem_count, height)
    points = steps(16 * fine, 2)
    trunks = bar(spline(paths, points), np.linspace(0.16, 0.05, points), steps(8 * fine, 3))
    return joined(pot(fine), trunks, leaves(paths, leaves_each, random, fine))
