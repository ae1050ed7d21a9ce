# SPDX-License-Identifier: GPL-3.0-only
"""What carpenters, locksmiths and upholsterers need: boards, bars, cushions, and many of a kind."""

from collections.abc import Callable, Iterable

import numpy as np

from model import vectors
from model.meshes import X, Y, moved, repeated, rotated
from model.portable import PI, sin
from model.shapes import box, surface, tubes

Array = np.ndarray
COARSE, MEDIUM = 0.1, 0.17  # of a lesser fineness, things are reduced to their main masses
FACES = ('bottom', 'top', 'front', 'back', 'left', 'right')  # of shapes.box; front is z, right x


def boxes(low: Array, high: Array, without: Iterable[str] = ()) -> Array:
    """Axis-aligned boxes from corners (n, 3), or one from (3), without some of their faces."""
    low, high = np.atleast_2d(low).astype(float), np.atleast_2d(high).astype(float)
    unit = box((0, 0, 0), (1, 1, 1)).reshape(6, 2, 3, 3)
    unit = unit[[face not in without for face in FACES]].reshape(-1, 3, 3)
    mesh = unit * (high - low)[:, np.newaxis, np.newaxis] + low[:, np.newaxis, np.newaxis]
    return mesh.reshape(-1, 3, 3)


def standing(mesh: Array, spots: Array) -> Array:
    """A copy of a mesh on each spot (x, y, z, angle about the vertical)."""
    spots = np.atleast_2d(spots)
    return repeated(mesh, vectors.rotation(Y, spots[:, 3]), spots[:, :3])


def placed(mesh: Array, x: float, y: float, z: float, angle: float = 0) -> Array:
    return moved(rotated(mesh, Y, angle), x, y, z)


def mirrored(path: Array) -> Array:
    """A path from the plane x = 0, preceded by its mirror image."""
    path = np.asarray(path, dtype=float)
    return np.concatenate([path[:0:-1] * [-1, 1, 1], path])


def bent(corners: Array, radius: float, bend_steps: int) -> Array:
    """A path along corners (n, 3), rounded by arcs of a parabola that start at that distance."""
    corners = np.asarray(corners, dtype=float)
    if bend_steps == 0:
        return corners
    t = np.arange(bend_steps + 1)[:, np.newaxis] / bend_steps
    path = [corners[:1]]
    for before, corner, after in zip(corners, corners[1:], corners[2:]):
        start = corner + radius * vectors.normalized(before - corner)
        end = corner + radius * vectors.normalized(after - corner)
        path.append((1 - t) * (1 - t) * start + 2 * t * (1 - t) * corner + t * t * end)
    return np.concatenate(path + [corners[-1:]])


def bar(path: Array, radius: float, segments: int, across: Array = X) -> Array:
    """A round bar; of fewer than 3 segments a flat band, whose width runs `across`."""
    if segments >= 3:
        return tubes(path, radius, segments)
    return surface(np.stack([path - radius * across, path + radius * across], axis=1))


def edge_dense(count: int) -> Array:
    """Numbers from -1 to 1, denser towards both ends."""
    return sin(np.arange(count + 1) * (PI / count) - PI / 2)


def cushion(shape: Callable[[Array, Array, Array], Array], columns: int, rows: int) -> Array:
    """An upholstered pad. `shape` places points of u and v in [-1, 1] and of a bulge that is 1 in
    the middle of the upper side, -1 in that of the lower side, and 0 along the seam.

    One of a single column is a flat sheet.
    """
    u, v = np.meshgrid(edge_dense(columns), edge_dense(rows), indexing='ij')
    bulge = np.sqrt(_falloff(u) * _falloff(v))
    if columns == 1:
        return surface(shape(u, v, bulge))
    return np.concatenate([surface(shape(u, v, bulge)), surface(shape(u, v, -bulge)[::-1])])


def seam(shape: Callable[[Array, Array, Array], Array], columns: int) -> Array:
    """The closed path around a cushion."""
    side = edge_dense(columns)
    one = np.ones(columns)
    u = np.concatenate([side[:-1], one, side[:0:-1], -one])
    v = np.concatenate([-one, side[:-1], one, side[:0:-1]])
    path = shape(u, v, np.zeros_like(u))
    return np.concatenate([path, path[:1]])


def rounded_square(u: Array, v: Array, corner: float) -> tuple[Array, Array]:
    """The square [-1, 1] with rounded corners; `corner` 0.5 makes it a circle."""
    return u * np.sqrt(1 - corner * v * v), v * np.sqrt(1 - corner * u * u)


def _falloff(t: Array) -> Array:
    squared = t * t
    return np.maximum(0, 1 - squared * squared * squared)
