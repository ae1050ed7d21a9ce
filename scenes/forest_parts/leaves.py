# SPDX-License-Identifier: GPL-3.0-only
"""Blades of leaves, of unit length: x runs along the midrib, z is the upper side."""

import numpy as np

from model import vectors
from model.meshes import joined, repeated

Array = np.ndarray


def blade(stations: list[tuple[float, float]], fold: float, curl: float) -> Array:
    """A leaf folded along its midrib; between base and tip it has half-widths at the stations.

    n stations make 4 n triangles, one of them without a bend of the midrib 2.
    """
    def bent(x: float, y: float) -> tuple[float, float, float]:
        return x, y, fold * abs(y) - curl * x * x

    base, tip = bent(0, 0), bent(1, 0)
    triangles = []
    for side in (-1, 1):
        middle = [base, *(bent(x, 0) for x, _ in stations), tip]
        edge = [bent(x, side * y) for x, y in stations]
        triangles.append((middle[0], edge[0], middle[1]))
        for i in range(len(stations) - 1):
            triangles.append((middle[i + 1], edge[i], edge[i + 1]))
            triangles.append((middle[i + 1], edge[i + 1], middle[i + 2]))
        triangles.append((middle[-2], edge[-1], middle[-1]))
    return np.array(triangles)


def simple_blade(position: float, half_width: float, fold: float) -> Array:
    """Two triangles that meet at the midrib."""
    rise = fold * half_width
    base, tip = (0, 0, 0), (1, 0, 0)
    return np.array([(base, (position, half_width, rise), tip),
                     (base, tip, (position, -half_width, rise))], dtype=float)


def area(mesh: Array) -> float:
    twice = vectors.length(vectors.cross(mesh[:, 1] - mesh[:, 0], mesh[:, 2] - mesh[:, 0]))
    return sum(twice.tolist()) / 2


def frames(direction: Array, upper: Array, length: Array, width: Array) -> Array:
    """Matrices that lay blades along directions, their upper sides towards `upper`."""
    along = vectors.normalized(direction)
    across = vectors.normalized(vectors.cross(upper, along))
    return vectors.frame(along * length[:, np.newaxis], across * width[:, np.newaxis],
                         vectors.cross(along, across) * length[:, np.newaxis])


def strewn(blades: list[Array], matrices: Array, positions: Array) -> Array:
    """Copies of several blades in turn."""
    n = len(blades)
    return joined([repeated(blades[i], matrices[i::n], positions[i::n]) for i in range(n)])
