# SPDX-License-Identifier: GPL-3.0-only
"""Moving, joining and repeating meshes."""

from collections.abc import Iterable

import numpy as np

from . import vectors

Array = np.ndarray
X, Y, Z = np.eye(3)


def joined(*meshes: Array | Iterable[Array]) -> Array:
    """One mesh of several, and of lists of meshes, in their order."""
    parts = [part for mesh in meshes
             for part in ([mesh] if isinstance(mesh, np.ndarray) else mesh)]
    return np.concatenate(parts) if parts else np.empty((0, 3, 3))


def moved(mesh: Array, x: float = 0, y: float = 0, z: float = 0) -> Array:
    return mesh + np.array([x, y, z], dtype=float)


def scaled(mesh: Array, x: float, y: float | None = None, z: float | None = None) -> Array:
    """Scaled about the origin: by one factor, or one for each axis."""
    return mesh * np.array([x, x if y is None else y, x if z is None else z], dtype=float)


def rotated(mesh: Array, axis: Array, angle: float) -> Array:
    """Rotated about an axis through the origin, counterclockwise as seen from its tip."""
    return vectors.transformed(mesh, vectors.rotation(axis, angle))


def repeated(mesh: Array, matrices: Array, offsets: Array) -> Array:
    """Copies of a mesh: the i-th is turned by matrices[i] (3, 3) and moved by offsets[i] (3)."""
    copies = vectors.transformed(mesh[np.newaxis],
                                 np.asarray(matrices)[:, np.newaxis, np.newaxis])
    copies += np.asarray(offsets)[:, np.newaxis, np.newaxis]
    return copies.reshape(-1, 3, 3)
