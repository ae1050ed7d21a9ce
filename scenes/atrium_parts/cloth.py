# SPDX-License-Identifier: GPL-3.0-only
"""Banners and curtains on rods, and swags, in folds that deepen downwards."""

import numpy as np

from model.meshes import joined, moved, repeated, rotated
from model.noise import gradient_noise
from model.portable import PI, cos, sin, smoothstep
from model.shapes import lathe, spline, surface, tubes

from .level import Level

Array = np.ndarray


def grid(level: Level, across: float, down: float) -> tuple[Array, Array]:
    """Parameters from 0 to 1 along the width (n, 1) and the height (1, m) of a cloth."""
    nu, nv = level.segments(across, 2), level.segments(down)
    return (np.arange(nu + 1) / nu)[:, np.newaxis], (np.arange(nv + 1) / nv)[np.newaxis]


def noise(u: Array, t: Array, seed: float) -> Array:
    return gradient_noise(np.stack(np.broadcast_arrays(u, t, seed + 0.5), axis=-1))


def folded(u: Array, t: Array, folds: float, seed: int) -> tuple[Array, Array]:
    """How far a fold lies to the front, and to the side: about -1 to 1."""
    phase = 2 * PI * (folds * u + np.minimum(1, 2 * t) * (
        1.1 * noise(u * 2.2, t * 0.9, seed) + 0.4 * noise(u * 6, t * 2.2, seed + 20)))
    height = 0.75 + 0.8 * noise(u * folds * 0.7, t * 1.3, seed + 40)
    return -cos(phase) * height, 0.45 * sin(2 * phase) * height


def banner(level: Level, width: float, length: float, seed: int) -> Array:
    """It hangs from a rod along x at the origin."""
    folds = 4
    u, t = grid(level, 80, 60)
    front, aside = folded(u, t, folds, seed)
    depth = 0.02 + 0.085 * smoothstep(0, 0.6, t)
    narrow = 1 - 0.1 * smoothstep(0, 0.6, t)
    x = (u - 0.5) * width * narrow + depth * aside * smoothstep(0, 0.4, t)
    sag = 0.03 * (1 - cos(2 * PI * folds * u)) * (1 - t) * (1 - t)
    middle = 2 * u - 1
    hem = 0.32 * (1 - np.abs(middle)) + 0.05 * noise(u * 4, t, seed + 60)
    y = -0.055 - sag - t * (length + hem)
    z = depth * front + 0.12 * t * t * noise(u * 0.8, t * 1.1, seed + 80)
    points = np.stack(np.broadcast_arrays(x, y, z), axis=-1)
    return surface(points) if level.coarse else joined(surface(points), rod(level, width, folds))


def rod(level: Level, width: float, rings: int) -> Array:
    half = width / 2 + 0.12
    parts = [tubes([[(-half, 0, 0), (half, 0, 0)]], 0.022, level.segments(10, 3))]
    if level.has(0.1):
        knob = lathe(level.outline([(0, -0.05), (0.05, 0, 0.21), (0.02, 0.06, 0.2), (0, 0.1)]),
                     level.segments(12, 4))
        parts += [moved(rotated(knob, [0, 0, 1], side * -PI / 2), x=side * half)
                  for side in (-1, 1)]
    if level.has(0.2):
        angle = np.arange(level.segments(14, 5) + 1) * (2 * PI / level.segments(14, 5))
        loop = np.stack([0 * angle, -0.012 + 0.042 * cos(angle), 0.042 * sin(angle)], axis=-1)
        eye = tubes(loop, 0.008, level.segments(6, 3), closed_ends=False)
        at = (np.arange(rings + 1) / rings - 0.5) * width
        offsets = np.stack([at, 0 * at, 0 * at], axis=-1)
        parts.append(repeated(eye, np.broadcast_to(np.eye(3), (len(at), 3, 3)), offsets))
    return joined(parts)


def stay(level: Level, reach: float) -> Array:
    """What carries a rod at one end: its way to the wall at x = reach, and a scroll below."""
    arm = spline(np.array([(-0.1, -0.02, 0), (0.2 * reach, -0.05, 0), (0.8 * reach, -0.3, 0),
                           (reach - 0.1, -0.55, 0)]), level.segments(16, 2) + 1)
    straight = np.array([(0.4, 0, 0), (reach, 0, 0)])
    return joined(tubes(arm, 0.016, level.segments(8, 3)),
                  tubes(straight, 0.022, level.segments(10, 3)))


def curtain(level: Level, width: float, length: float, seed: int) -> Array:
    """It hangs from y = 0 between x = 0 and the width, and is tied to the side at x = 0."""
    folds = 9
    u, t = grid(level, 100, 60)
    tie = 0.58
    above = smoothstep(0, tie, t)
    below = smoothstep(tie, 1, t)
    span = np.where(t < tie, 1 - (1 - 0.15) * above * above, 0.15 + 0.13 * below)
    front, aside = folded(u, 0.25 + 0.4 * t, folds, seed)
    depth = 0.035 + 0.045 * above - 0.02 * np.where(t < tie, 0, 0.3)
    slack = 0.28 * u * (1 - u) * 4 * above * np.where(t < tie, 1, 1 - below)
    x = 0.1 + u * width * span + 0.3 * depth * aside * span
    drop = u * (1 - span) * 0.12 * width * np.where(t < tie, 1, 0.4)
    y = -t * length - drop * above * (1 - below) - 0.25 * slack * (1 - t)
    z = depth * front * (0.6 + 0.5 * above) + 0.04 * noise(u * 2, t * 2, seed + 90)
    cloth = surface(np.stack(np.broadcast_arrays(x, y, z), axis=-1))
    if level.coarse:
        return cloth
    band = 0.1 + width * 0.075
    angle = np.arange(level.segments(16, 4) + 1) * (2 * PI / level.segments(16, 4))
    loop = np.stack([band + (0.05 + width * 0.085) * cos(angle), -tie * length - 0.05 * cos(angle),
                     0.13 * sin(angle)], axis=-1)
    return joined(cloth, tubes(loop, 0.028, level.segments(8, 3), closed_ends=False))


def swag(level: Level, width: float, drop: float, seed: int) -> Array:
    """A cloth that hangs between two points in hollows one below the other, from y = 0."""
    u, t = grid(level, 36, 44)
    folds = 5
    arch = 4 * u * (1 - u)
    lean = arch * (0.25 + 0.75 * arch)
    phase = 2 * PI * (folds * t + 0.25 * noise(u * 2.5, t * 3, seed))
    y = -lean * drop * (0.12 + 0.88 * t) - 0.10 * t * (1 - arch) - 0.012 * sin(2 * phase) * arch
    z = -(0.05 + 0.085 * arch) * (0.5 - 0.5 * cos(phase)) - 0.1 * arch * t * (1.2 - t)
    x = (u - 0.5) * width * (1 - 0.02 * sin(phase))
    return surface(np.stack(np.broadcast_arrays(x, y, z), axis=-1))
