# SPDX-License-Identifier: GPL-3.0-only
"""Urns, amphorae, the fountain, and trees in pots."""

import numpy as np

from model.meshes import joined, moved, repeated, scaled
from model.noise import gradient_noise
from model.portable import PI, Random, cos, sin
from model.shapes import circle, lathe, quad, spline, surface, tubes
from model.vectors import cross, frame, normalized, perpendicular, rotation

from .level import Level
from .mouldings import square

Array = np.ndarray


def ribbed(profile: Array, segments: int, ribs: int, low: float, high: float) -> Array:
    """A lathe whose body swells into ribs between two heights."""
    ring = circle(segments)[::-1]
    height = profile[:, 1]
    t = np.clip((height - low) / (high - low), 0, 1)
    swell = 0.06 * sin(PI * t)
    wave = np.abs(cos(np.arange(segments) * (ribs * PI / segments)))
    radius = profile[:, 0] * (1 - swell * (1 - wave[:, np.newaxis]) * 1.6)
    return surface(np.stack([ring[:, :1] * radius, np.broadcast_to(height, radius.shape),
                             ring[:, 1:] * radius], axis=-1), closed_u=True)


def urn(level: Level) -> Array:
    """A small covered one, for the niches."""
    return lathe(level.outline([
        (0.13, 0), (0.13, 0.04), (0.05, 0.1, -0.3), (0.05, 0.13), (0.19, 0.42, 0.2),
        (0.15, 0.5, 0.1), (0.09, 0.55, -0.3), (0.12, 0.6), (0.12, 0.62), (0.04, 0.7, 0.2),
        (0.045, 0.74, 0.5), (0, 0.77, 0.3)]), level.segments(16, 4))


def amphora(level: Level) -> Array:
    """A tall jar of half a man's height with two handles, on a plinth."""
    body = level.outline([
        (0.14, 0.15), (0.16, 0.19, 0.4), (0.1, 0.24, -0.3), (0.31, 0.78, 0.16),
        (0.28, 0.95, 0.12), (0.12, 1.1, -0.22), (0.11, 1.22), (0.17, 1.29, -0.2),
        (0.18, 1.32, 0.4), (0.15, 1.31), (0.09, 1.2), (0.09, 1.0)])
    plinth = level.outline([(0.24, -0.03), (0.24, 0.1), (0.21, 0.13, -0.2), (0.2, 0.15),
                            (0.05, 0.15)])
    parts = [ribbed(body, level.segments(48, 5), 16, 0.26, 0.9), square(plinth)]
    if level.has(0.03):
        path = spline(np.array([(0.1, 1.2, 0), (0.2, 1.27, 0), (0.31, 1.17, 0), (0.29, 0.95, 0)]),
                      level.segments(16, 4) + 1)
        grip = tubes(path, 0.022, level.segments(10, 3))
        parts += [grip, scaled(grip, -1, 1, 1)]
    return joined(parts)


def pot(level: Level) -> Array:
    """A terracotta pot with a rim and a garland, filled with earth."""
    return lathe(level.outline([
        (0.27, -0.03), (0.27, 0.03), (0.29, 0.06, 0.4), (0.36, 0.42, 0.04), (0.385, 0.44, 0.5),
        (0.37, 0.47, 0.5), (0.4, 0.6), (0.44, 0.6), (0.46, 0.66, 0.4), (0.44, 0.7, 0.3),
        (0.4, 0.7), (0.385, 0.6), (0.15, 0.64, 0.05), (0, 0.63)]), level.segments(40, 6))


def tree(level: Level, seed: int) -> Array:
    """A clipped orange tree in a pot: its leaves stand in a ball with hollows, fruits between."""
    random = Random(seed)
    middle, radius = np.array([0.0, 2.0, 0.0]), 0.62
    stem = spline(np.array([(0, 0.6, 0), (0.03, 1.0, 0.02), (-0.03, 1.4, -0.02), (0, 1.9, 0)]),
                  level.segments(8, 2) + 1)
    if level.coarse:
        return joined(lathe([(0.3, 0), (0.4, 0.7)], 4),
                      moved(lathe([(0, -0.6), (0.55, 0), (0, 0.6)], 4), *middle))
    parts = [pot(level), tubes(stem, 0.045, level.segments(10, 3))]
    if not level.has(0.05):
        ball = lathe([(0, -0.6), (0.55, -0.2), (0.55, 0.25), (0, 0.6)], 5)
        return joined(parts, moved(ball, *middle))
    outward = random.direction(level_count(level, 3600))
    bumps = 1 + 0.16 * gradient_noise(outward * 2.4 + seed * 7.3)
    reach = radius * bumps * random.uniform(0.72, 1.05, len(outward))
    position = middle + outward * reach[:, np.newaxis]
    along = normalized(outward + 0.9 * random.direction(len(outward)) + np.array([0, 0.15, 0]))
    side = perpendicular(along)
    turn = rotation(along, random.uniform(0, 2 * PI, len(along)))
    side = normalized(turn[..., 0] * side[:, :1] + turn[..., 1] * side[:, 1:2]
                      + turn[..., 2] * side[:, 2:])
    size = random.uniform(0.8, 1.25, (len(outward), 1, 1))
    parts.append(repeated(blade(level), frame(side, cross(along, side), along) * size, position))
    if level.has(0.3):
        fruit = random.direction(16)
        at = middle + fruit * (radius * (1 + 0.16 * gradient_noise(fruit * 2.4 + seed * 7.3))
                               )[:, np.newaxis]
        ball = lathe(level.outline([(0, -0.05), (0.05, 0, 0.21), (0, 0.05, 0.21)]),
                     level.segments(10, 4))
        parts.append(repeated(ball, np.broadcast_to(np.eye(3), (16, 3, 3)), at))
    return joined(parts)


def level_count(level: Level, ideal: int) -> int:
    return max(1, int(ideal * min(level.detail, 4.0)))


def blade(level: Level) -> Array:
    """A leaf along z, folded along its middle."""
    along = level.segments(2, 2)
    t = np.arange(along + 1) / along
    width = 0.036 * sin(PI * (0.06 + 0.94 * t))
    points = [np.stack([side * width, 0.45 * np.abs(side) * width - 0.03 * t * t, 0.13 * t], -1)
              for side in (-1, 0, 1)]
    return surface(np.array(points))


def bench(level: Level) -> Array:
    """A stone slab along x on two scrolled feet."""
    slab = level.outline([(0.2, 0.4), (0.22, 0.42, 0.3), (0.22, 0.45), (0.25, 0.48, -0.2),
                          (0.25, 0.51), (0.24, 0.52, 0.3), (0, 0.525)])
    corners = ((-1, -1), (-1, 1), (1, 1), (1, -1))
    seat = np.array([[(sx * (0.6 + r), y, sz * r) for r, y in slab.tolist()] for sx, sz in corners])
    foot = level.outline([(0.2, -0.03), (0.2, 0.06), (0.13, 0.12, -0.3), (0.1, 0.22, -0.1),
                          (0.19, 0.38, -0.2), (0.2, 0.41, 0.3)])
    both = np.concatenate([foot, foot[::-1] * np.array([-1, 1])])
    sides = [np.stack([np.full(len(both), x), both[:, 1], both[:, 0]], -1) for x in (-0.06, 0.06)]
    cheeks = [surface(np.array([side[:len(foot)], side[:len(foot) - 1:-1]])) for side in sides]
    block = joined(surface(np.array(sides)), cheeks)
    return joined(surface(seat, closed_u=True), quad(*seat[:, 0]), moved(block, x=-0.55),
                  moved(block, x=0.55))


def fountain(level: Level) -> Array:
    """Two round steps, a basin with water, and a bowl on a stem in its middle."""
    segments = level.segments(96, 6)
    steps = [(2.6, -0.05), (2.6, 0.11), (2.56, 0.14, 0.3), (2.15, 0.14), (2.15, 0.25),
             (2.11, 0.28, 0.3), (1.5, 0.28)]
    basin = [(1.76, 0.27), (1.76, 0.34), (1.72, 0.38, -0.2), (1.66, 0.42, 0.2), (1.62, 0.72),
             (1.66, 0.76, 0.4), (1.66, 0.79), (1.8, 0.9, -0.22), (1.84, 0.9), (1.87, 0.96, 0.5),
             (1.8, 1.0, 0.3), (1.5, 1.0), (1.46, 0.97, 0.3), (1.44, 0.7), (1.44, 0.5)]
    stem = [(0.42, 0.5), (0.42, 0.9), (0.36, 0.96, -0.3), (0.3, 1.0), (0.16, 1.12, -0.25),
            (0.15, 1.16), (0.2, 1.2, 0.5), (0.15, 1.24, 0.5), (0.24, 1.52, 0.22),
            (0.11, 1.78, -0.12), (0.11, 1.84), (0.17, 1.88, 0.5), (0.15, 1.92, 0.3)]
    bowl = [(0.12, 1.9), (0.5, 1.99, 0.1), (0.84, 2.2, 0.14), (0.9, 2.24), (0.93, 2.29, 0.5),
            (0.86, 2.32, 0.2), (0.82, 2.3), (0.55, 2.15, 0.08), (0.1, 2.1)]
    finial = [(0.1, 2.08), (0.09, 2.3), (0.13, 2.34, 0.5), (0.08, 2.38, 0.5), (0.15, 2.55, 0.25),
              (0.07, 2.7, 0.05), (0.05, 2.72), (0.08, 2.8, 0.4), (0.0, 2.9, 0.2)]
    if level.coarse:
        return joined(lathe([(2.4, 0), (1.8, 0.3)], 6), lathe([(1.7, 0.2), (1.8, 1)], 6),
                      water(level, 1.75, 0.9), lathe([(0.2, 0.8), (0.2, 2.0), (0.9, 2.3)], 4))
    small = level.segments(32, 4)
    parts = [lathe(level.outline(steps), segments), lathe(level.outline(basin), segments),
             lathe(level.outline(stem), small),
             ribbed(level.outline(bowl), level.segments(96, 6), 24, 1.92, 2.22),
             water(level, 1.45, 0.86)]
    if level.has(0.02):
        parts.append(lathe(level.outline(finial), small))
    return joined(parts)


def water(level: Level, radius: float, y: float) -> Array:
    """A disc with ripples that run outwards."""
    around, out = level.segments(64, 6), level.segments(30)
    ring, t = circle(around), np.arange(out + 1) / out
    x, z = ring[:, :1] * t * radius, ring[:, 1:] * t * radius
    ripple = 0.012 * sin(t * 34) * (1 - t) + 0.02 * gradient_noise(
        np.stack([x * 3, np.full(x.shape, 0.5), z * 3], axis=-1))
    return surface(np.stack([x, y + ripple, z], axis=-1), closed_u=True)
