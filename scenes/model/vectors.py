# SPDX-License-Identifier: GPL-3.0-only
"""Vectors are the last axis of an array. Sums run in a fixed order."""

import numpy as np

from .portable import cos, sin

Array = np.ndarray


def dot(a: Array, b: Array) -> Array:
    product = np.asarray(a) * np.asarray(b)
    return product[..., 0] + product[..., 1] + product[..., 2]


def cross(a: Array, b: Array) -> Array:
    a, b = np.broadcast_arrays(np.asarray(a, dtype=float), np.asarray(b, dtype=float))
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length(a: Array) -> Array:
    return np.sqrt(dot(a, a))


def normalized(a: Array) -> Array:
    """Unit vectors; a vector of length 0 stays 0."""
    norm = length(a)[..., np.newaxis]
    return np.asarray(a) / np.where(norm > 0, norm, 1)


def perpendicular(a: Array) -> Array:
    """A unit vector at right angles to each of the unit vectors a."""
    a = np.asarray(a, dtype=float)
    axis = np.where(np.abs(a[..., :1]) < 0.7, np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
    return normalized(cross(a, axis))


def rotation(axis: Array, angle: Array | float) -> Array:
    """Matrices (..., 3, 3) that rotate about unit vectors, by angles in radians (Rodrigues)."""
    axis, angle = np.asarray(axis, dtype=float), np.asarray(angle, dtype=float)
    c, s = cos(angle)[..., np.newaxis, np.newaxis], sin(angle)[..., np.newaxis, np.newaxis]
    x, y, z = axis[..., 0], axis[..., 1], axis[..., 2]
    zero = np.zeros_like(x)
    skew = np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1),
                     np.stack([-y, x, zero], -1)], -2)
    outer = axis[..., :, np.newaxis] * axis[..., np.newaxis, :]
    return c * np.eye(3) + s * skew + (1 - c) * outer


def frame(x: Array, y: Array, z: Array) -> Array:
    """Matrices (..., 3, 3) that take the coordinate axes to x, y and z."""
    return np.stack(np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (x, y, z))), axis=-1)


def transformed(points: Array, matrix: Array) -> Array:
    """Matrices (..., 3, 3) times points (..., 3); the leading axes are broadcast."""
    points = np.asarray(points, dtype=float)
    return (points[..., 0:1] * matrix[..., :, 0] + points[..., 1:2] * matrix[..., :, 1]
            + points[..., 2:3] * matrix[..., :, 2])
