# SPDX-License-Identifier: GPL-3.0-only
"""Cups, glasses, carafes and bowls. All stand on the origin."""

import numpy as np

from model import vectors
from model.meshes import joined, moved
from model.portable import Random
from model.shapes import lathe, smooth_lathe, sphere, spline, steps

from .basics import bar

Array = np.ndarray


def turned(profile: list[tuple[float, float]], fine: float, rings: int, segments: int) -> Array:
    """A lathe along a smooth curve through the profile."""
    return smooth_lathe(profile, steps(rings * fine, len(profile) // 2 + 1),
                        steps(segments * fine, 5))


def saucer(fine: float) -> Array:
    profile = [(0, 0.02), (0.42, 0.0), (0.48, 0.05), (0.7, 0.1), (0.8, 0.18), (0.78, 0.2),
               (0.6, 0.12), (0.35, 0.08), (0, 0.08)]
    return turned(profile, fine, 20, 40)


def cup(fine: float) -> Array:
    """A coffee cup with its handle at +x, filled."""
    profile = [(0, 0.02), (0.22, 0.0), (0.25, 0.03), (0.36, 0.22), (0.41, 0.5), (0.43, 0.62),
               (0.41, 0.63), (0.38, 0.5), (0.37, 0.45)]
    coffee = lathe([(0.375, 0.45), (0, 0.45)], steps(36 * fine, 5))
    handle = spline([(0.37, 0.5, 0), (0.55, 0.55, 0), (0.65, 0.42, 0), (0.57, 0.24, 0),
                     (0.34, 0.19, 0)], steps(16 * fine, 3))
    return joined(turned(profile, fine, 24, 36), coffee,
                  bar(handle, 0.045, steps(10 * fine, 3), np.array([0, 0, 1.0])))


def spoon(fine: float) -> Array:
    path = spline([(-0.55, 0.06, 0), (-0.4, 0.0, 0), (-0.2, 0.07, 0), (0.6, 0.05, 0)],
                  steps(16 * fine, 5))
    radius = spline([(0.02, 0), (0.11, 0), (0.03, 0), (0.04, 0)], len(path))[:, 0]
    return bar(path, radius, steps(8 * fine, 3))


def cup_and_saucer(fine: float) -> Array:
    return joined(saucer(fine), moved(cup(fine), 0, 0.085, 0),
                  moved(spoon(fine), 0, 0.2, 0.55) if fine > 0.3 else [])


def glass(fine: float) -> Array:
    """A tumbler, half full of water."""
    profile = [(0.0, 0.03), (0.26, 0.005), (0.29, 0.04), (0.33, 0.6), (0.35, 1.1), (0.345, 1.115),
               (0.335, 1.1), (0.32, 0.75), (0.31, 0.6)]
    water = lathe([(0.316, 0.62), (0, 0.62)], steps(32 * fine, 5))
    return joined(turned(profile, fine, 22, 32), water)


def carafe(fine: float) -> Array:
    profile = [(0, 0.03), (0.45, 0.0), (0.55, 0.1), (0.6, 0.6), (0.5, 1.3), (0.27, 1.9),
               (0.23, 2.2), (0.34, 2.6), (0.32, 2.6), (0.2, 2.2), (0.22, 1.95)]
    stopper = [(0.19, 2.25), (0.24, 2.5), (0.12, 2.66), (0.22, 2.85), (0.16, 3.0), (0, 3.02)]
    return joined(turned(profile, fine, 40, 44), turned(stopper, fine, 20, 32))


def tray(fine: float) -> Array:
    profile = [(0, 0.02), (1.75, 0.0), (1.85, 0.06), (1.9, 0.2), (1.86, 0.21), (1.78, 0.08),
               (0, 0.07)]
    return turned(profile, fine, 16, 64)


def apple(fine: float) -> Array:
    profile = [(0, 0.06), (0.1, 0.0), (0.3, 0.12), (0.38, 0.4), (0.28, 0.63), (0.1, 0.64),
               (0, 0.56)]
    stalk = spline([(0, 0.52, 0), (0.01, 0.66, 0), (0.06, 0.78, 0.02)], 4)
    return joined(turned(profile, fine, 18, 26), bar(stalk, 0.02, 3))


def fruit_bowl(fine: float) -> Array:
    profile = [(0, 0.02), (0.55, 0.0), (0.6, 0.05), (1.2, 0.45), (1.55, 0.8), (1.52, 0.82),
               (1.1, 0.48), (0.5, 0.16), (0, 0.12)]
    random = Random(5)
    spots = [(0, 0.14, 0), (0.75, 0.33, 0.05), (-0.38, 0.33, 0.65), (-0.36, 0.34, -0.66),
             (0.42, 0.36, -0.72), (0.1, 0.72, 0.28)]
    fruit = apple(fine)
    turns = vectors.rotation(random.direction(len(spots)), random.uniform(-0.5, 0.5, len(spots)))
    apples = [vectors.transformed(fruit - [0, 0.35, 0], turn) + [0, 0.35, 0] + spot
              for turn, spot in zip(turns, np.array(spots))]
    return joined(turned(profile, fine, 28, 56), apples)


def vase(fine: float) -> Array:
    profile = [(0, 0.02), (0.55, 0.0), (0.8, 0.5), (0.95, 1.2), (0.7, 2.2), (0.3, 2.9), (0.28, 3.2),
               (0.4, 3.5), (0.36, 3.5), (0.24, 3.2)]
    return turned(profile, fine, 40, 48)


def globe(fine: float) -> Array:
    """On a foot, held by a half ring."""
    profile = [(0, 0.02), (0.7, 0.0), (0.72, 0.1), (0.2, 0.25), (0.12, 0.6), (0, 0.62)]
    foot = turned(profile, fine, 20, 36)
    ball = moved(sphere(0.95, steps(44 * fine, 6)), 0, 1.75, 0)
    arc = spline([(0.35, 0.6, 0), (1.0, 0.95, 0), (1.18, 1.75, 0), (0.95, 2.5, 0), (0.3, 2.88, 0)],
                 steps(20 * fine, 4))
    return joined(foot, ball, bar(arc, 0.05, steps(8 * fine, 3)))
