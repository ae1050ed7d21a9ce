# SPDX-License-Identifier: GPL-3.0-only
"""Gradient noise (Perlin, "Improving Noise", 2002), with gradients from a hash of the lattice."""

import numpy as np

Array = np.ndarray

_GRADIENTS = np.array([[1, 1, 0], [-1, 1, 0], [1, -1, 0], [-1, -1, 0],
                       [1, 0, 1], [-1, 0, 1], [1, 0, -1], [-1, 0, -1],
                       [0, 1, 1], [0, -1, 1], [0, 1, -1], [0, -1, -1]], dtype=float)


def _hash(x: Array, y: Array, z: Array, seed: int) -> Array:
    """32 well mixed bits of each lattice point."""
    h = (x.astype(np.uint32) * np.uint32(0x8DA6B343) ^ y.astype(np.uint32) * np.uint32(0xD8163841)
         ^ z.astype(np.uint32) * np.uint32(0xCB1AB31F) ^ np.uint32(seed * 0x9E3779B1 & 0xFFFFFFFF))
    for shift, factor in ((16, 0x7FEB352D), (15, 0x846CA68B)):
        h = (h ^ (h >> np.uint32(shift))) * np.uint32(factor)
    return h ^ (h >> np.uint32(16))


def gradient_noise(points: Array, seed: int = 0) -> Array:
    """Smooth noise of points (..., 3), about -1 to 1, 0 at lattice points; details have size 1."""
    points = np.asarray(points, dtype=float)
    cell = np.floor(points)
    t = points - cell
    base = cell.astype(np.int64)
    fade = t * t * t * (t * (t * 6 - 15) + 10)
    value = np.zeros(points.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.ones_like(value)
        for axis in range(3):
            weight = weight * (fade[..., axis] if corner[axis] else 1 - fade[..., axis])
        at = base + np.array(corner)
        gradient = _GRADIENTS[_hash(at[..., 0], at[..., 1], at[..., 2], seed) % np.uint32(12)]
        d = t - np.array(corner, dtype=float)
        value = value + weight * (gradient[..., 0] * d[..., 0] + gradient[..., 1] * d[..., 1]
                                  + gradient[..., 2] * d[..., 2])
    return value


def fractal_noise(points: Array, octaves: int, seed: int = 0) -> Array:
    """Octaves of gradient noise, each of half the size and half the height of the one before."""
    points = np.asarray(points, dtype=float)
    return sum(gradient_noise(points * 2.0**i, seed + i) * 0.5**i for i in range(octaves))
