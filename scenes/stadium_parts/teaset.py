# SPDX-License-Identifier: GPL-3.0-only
"""The teapot on a round platform on the centre spot, with cups and saucers around it."""

import numpy as np

from model.meshes import joined, moved, rotated, scaled, Y
from model.shapes import lathe, rounded_box, smooth_lathe, spline, steps, tubes

from .teapot import teapot

Array = np.ndarray

SCALE = 0.23  # of Newell's measures
TURN = 1.85  # of the spout, from x away from z
PLATFORM = 0.26  # its height
SUNK = 0.003  # how deep things stand in what carries them
CUPS = [(-0.65, 0.9, 1.2), (0.85, 1.05, 2.9)]  # x, z, turn of each

LUMP = 0.11  # size of a lump of sugar
LUMPS = [(-0.95, 0, -0.42, 0.3), (-0.99, 0, -0.28, 1.0), (-0.74, 0, -0.62, 0.75),
         (-0.965, 0.985, -0.35, 0.6)]  # x, layer, z, turn of each


def platform(segments: int) -> Array:
    """Two steps with rounded edges."""
    return lathe([(2.35, -0.1), (2.35, 0.09), (2.33, 0.12), (2.3, 0.13), (1.92, 0.13),
                  (1.92, 0.22), (1.9, 0.25), (1.87, PLATFORM), (0, PLATFORM)], segments)


def plain_platform(segments: int) -> Array:
    return lathe([(2.35, -0.1), (1.87, PLATFORM), (0, PLATFORM)], segments)


def cup(segments: int) -> Array:
    profile = [(0, 0.03), (0.08, 0.03), (0.09, 0.0), (0.1, 0.0), (0.1, 0.035), (0.15, 0.09),
               (0.185, 0.17), (0.2, 0.25), (0.193, 0.254), (0.186, 0.25), (0.17, 0.17),
               (0.135, 0.1), (0.08, 0.055), (0, 0.05)]
    handle = spline(np.array([(0.17, 0.205, 0), (0.24, 0.22, 0), (0.285, 0.18, 0),
                              (0.26, 0.125, 0), (0.21, 0.095, 0), (0.15, 0.1, 0)]), segments)
    return joined(turned(profile, segments), tubes(handle, 0.014, steps(segments / 5, 4)))


def saucer(segments: int) -> Array:
    return turned([(0.0, 0.0), (0.17, 0.0), (0.2, 0.012), (0.36, 0.055), (0.365, 0.064),
                         (0.355, 0.067), (0.2, 0.026), (0.17, 0.018), (0.0, 0.016)], segments)


def sugar(segments: int) -> Array:
    """Some lumps; the last lies on others."""
    half = LUMP / 2
    lump = rounded_box((-half, 0, -half), (half, LUMP, half), 0.015, segments)
    return joined(moved(rotated(lump, Y, turn), x, layer * LUMP + PLATFORM - SUNK, z)
                  for x, layer, z, turn in LUMPS)


def turned(profile: list[tuple[float, float]], segments: int) -> Array:
    return smooth_lathe(profile, max(len(profile), segments * 2 // 3), segments)


def teaset(fineness: float) -> Array:
    segments = min(steps(48 * fineness, 2), 120)
    pot = moved(rotated(scaled(teapot(segments), SCALE), Y, TURN), y=PLATFORM - SUNK)
    if fineness < 0.07:
        return joined(plain_platform(12), pot)
    set_of_one = joined(moved(cup(steps(40 * fineness, 8)), y=0.016 - SUNK),
                        saucer(steps(48 * fineness, 8)))
    sets = [moved(rotated(set_of_one, Y, turn), x, PLATFORM - SUNK, z) for x, z, turn in CUPS]
    return joined(platform(steps(96 * fineness, 24)), pot, sets, sugar(steps(5 * fineness, 1)))
