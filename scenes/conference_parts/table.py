# SPDX-License-Identifier: GPL-3.0-only
"""The boat-shaped table, along x, on three pedestals, with cable ports along its middle."""

import numpy as np

from model import vectors
from model.meshes import joined, moved, rotated, scaled, X
from model.portable import PI, cos, power, sin
from model.shapes import lathe, rounded_box, steps, surface

from .basics import COARSE, boxes

Array = np.ndarray
HALF_LENGTH, HALF_WIDTH = 33.0, 10.0
TOP = 7.4
BOAT = 0.24  # by how much of its width the table is narrower at the ends
EDGE = [(0.06, 0.0), (0.018, -0.018), (0.0, -0.06), (0.0, -0.2), (0.02, -0.25), (0.09, -0.28),
        (1.7, -0.62)]  # the profile from the top downwards: inset, height
PEDESTALS_X = (-22.0, 0.0, 22.0)
PORTS_X = (-24.0, -8.5, 8.5, 24.0)


def half_width(x: Array | float) -> Array:
    t = np.asarray(x) / HALF_LENGTH
    return HALF_WIDTH * (1 - BOAT * t * t)


def outline(points: int) -> Array:
    """Half of the outline (points, 2) from +x to -x on the side of +z: a superellipse, bent like
    a boat."""
    angle = np.arange(points) * (PI / (points - 1))
    c = cos(angle)
    x = HALF_LENGTH * np.sign(c) * power(np.abs(c), 0.3)
    z = half_width(x) * power(np.maximum(0, sin(angle)), 0.3)
    x[0], x[-1], z[0], z[-1] = HALF_LENGTH, -HALF_LENGTH, 0, 0
    return np.stack([x, z], axis=-1)


def inset_outline(inset: float, height: float, points: int) -> Array:
    """The whole outline, drawn in by that much: (2 * points - 2, 3)."""
    half = outline(points)
    whole = np.concatenate([half, half[-2:0:-1] * [1, -1]])
    along = np.roll(whole, -1, axis=0) - np.roll(whole, 1, axis=0)
    normal = vectors.normalized(np.stack([along[:, 1], 0 * along[:, 0], -along[:, 0]], axis=-1))
    flat = np.stack([whole[:, 0], np.full(len(whole), TOP + height), whole[:, 1]], axis=-1)
    return flat - inset * normal


def cap(ring: Array) -> Array:
    """Across a ring, from each point to the one opposite."""
    points = len(ring) // 2 + 1
    return surface(np.stack([ring[:points], np.roll(ring[::-1], 1, axis=0)[:points]], axis=1))


def top(fine: float) -> Array:
    points = steps(90 * fine, 5)
    profile = EDGE if fine > COARSE else EDGE[::6]
    rings = [inset_outline(inset, height, points) for inset, height in profile]
    return joined(surface(np.stack(rings, axis=1), closed_u=True), cap(rings[0]), cap(rings[-1]))


def pedestal(fine: float) -> Array:
    """An elliptical column that widens towards floor and table, on a flat foot."""
    rings = steps(20 * fine, 1)
    t = np.arange(rings + 1) / rings
    waist = 4 * t * (1 - t)
    column = np.stack([1.5 - 0.75 * waist * (1.25 - 0.5 * t), 0.3 + (TOP - 0.8) * t], axis=-1)
    foot = [(3.0, -0.02), (3.0, 0.14), (2.96, 0.2), (1.9, 0.3), (0, 0.3)]
    segments = steps(56 * fine, 4)
    feet = lathe(foot, segments) if fine > COARSE else []
    return scaled(joined(lathe(column, segments), feet), 1.5, 1, 1.1)


def port(fine: float) -> Array:
    """A frame on the table with six sockets, under a lid that stands half open."""
    frame = joined(boxes([(-1.5, TOP - 0.01, -0.6), (-1.5, TOP - 0.01, 0.5)],
                         [(1.5, TOP + 0.05, -0.5), (1.5, TOP + 0.05, 0.6)], ('bottom',)),
                   boxes([(-1.5, TOP - 0.01, -0.5), (1.4, TOP - 0.01, -0.5)],
                         [(-1.4, TOP + 0.05, 0.5), (1.5, TOP + 0.05, 0.5)],
                         ('bottom', 'front', 'back')))
    x = np.arange(6) * 0.44 - 1.1
    at = np.stack([x, np.full(6, TOP - 0.01), np.zeros(6)], axis=-1)
    sockets = boxes(at - [0.17, 0, 0.3], at + [0.17, 0.03, 0.3], ('bottom',))
    lid = rotated(rounded_box((-1.48, 0, -0.06), (1.48, 0.08, 1.06), 0.03, steps(3 * fine, 1)),
                  X, -1.15)
    return joined(frame, sockets, moved(lid, 0, TOP + 0.08, -0.52))


def table(fine: float) -> Array:
    parts = [top(fine)] + [moved(pedestal(fine), x) for x in PEDESTALS_X]
    if fine > 0.2:
        parts += [moved(port(fine), x) for x in PORTS_X]
    return joined(parts)
