# SPDX-License-Identifier: GPL-3.0-only
"""Surfaces where a function of space is zero: shapes to make such functions of, and their mesh.

Points are arrays (3, n) here, the coordinates first. A function gives about the distance from its
surface, negative inside.
"""

from collections.abc import Callable
from itertools import permutations

import numpy as np

Array = np.ndarray
Function = Callable[[Array], Array]

CELL_RADIUS = 0.83  # in lattice spacings
CORNERS = np.array(list(np.ndindex(2, 2, 2)))
CHUNK = 16384  # points that a function gets at a time, few enough for the processor's caches
CELLS_AT_ONCE = 65536
CLEARANCE = 0.2  # no point of the lattice is nearer to the surface, in lattice spacings


def ellipsoid(p: Array, center: Array, radii: Array) -> Array:
    """Axis-aligned. About the distance: exact to the first order at the surface."""
    scaled = (p - np.reshape(center, (3, 1))) / np.reshape(radii, (3, 1))
    first = _length(scaled)
    second = _length(scaled / np.reshape(radii, (3, 1)))
    return first * (first - 1) / np.where(second > 0, second, 1)


def round_cone(p: Array, a: Array, b: Array, radius_a: float, radius_b: float) -> Array:
    """Balls of linearly changing radius along a segment."""
    a, b = np.reshape(a, (3, 1)), np.reshape(b, (3, 1))
    axis, q = b - a, p - a
    t = np.clip(_dot(q, axis) / _dot(axis, axis), 0, 1)
    return _length(q - t * axis) - (radius_a + t * (radius_b - radius_a))


def limb(p: Array, joints: Array, radii: Array, blend: float) -> Array:
    """Round cones from joint to joint."""
    cones = [round_cone(p, a, b, ra, rb)
             for a, b, ra, rb in zip(joints, joints[1:], radii, radii[1:])]
    return united(cones, blend)


def rounded_block(p: Array, center: Array, half: Array, radius: float) -> Array:
    q = np.abs(p - np.reshape(center, (3, 1))) - (np.reshape(half, (3, 1)) - radius)
    outside = _length(np.maximum(q, 0))
    return outside + np.minimum(np.maximum(np.maximum(q[0], q[1]), q[2]), 0) - radius


def smooth_min(a: Array, b: Array, blend: float) -> Array:
    """The minimum, with a parabola where the two differ by less than `blend`."""
    h = np.maximum(blend - np.abs(a - b), 0)
    return np.minimum(a, b) - h * h / (4 * blend)


def smooth_max(a: Array, b: Array, blend: float) -> Array:
    return -smooth_min(-a, -b, blend)


def united(distances: list[Array], blend: float) -> Array:
    total = distances[0]
    for distance in distances[1:]:
        total = smooth_min(total, distance, blend)
    return total


def _dot(a: Array, b: Array) -> Array:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _length(a: Array) -> Array:
    return np.sqrt(_dot(a, a))


def polygonised(function: Function, low: Array, high: Array, spacing: float,
                steepness: float = 2) -> Array:
    """The closed mesh of the surface inside a box, by marching tetrahedra.

    The lattice is the body-centred cubic one, whose tetrahedra are all alike. Points of the
    lattice that are close to the surface give way to it, so there are no slivers. A vertex is
    computed from the ends of its edge of the lattice alone, always in the same order: triangles
    that share it have the same bits. The function must not change faster than by `steepness`
    times the distance between two points, over distances of a few spacings.
    """
    cells = _cells_at_surface(function, np.asarray(low), np.asarray(high), spacing, steepness)
    meshes = [_mesh(function, cells[i:i + CELLS_AT_ONCE], spacing, steepness)
              for i in range(0, len(cells), CELLS_AT_ONCE)]
    return np.concatenate(meshes)


def _cells_at_surface(function: Function, low: Array, high: Array, spacing: float,
                      steepness: float) -> Array:
    """Cells (n, 3) of the lattice that the surface may meet, in an order that keeps neighbours
    together: found by halving the cells of a coarse lattice."""
    size = 1
    while size * spacing < np.max(high - low) / 16:
        size *= 2
    first, last = (np.floor((np.roll(c, 1) + np.roll(c, 2)) / (spacing * size)).astype(int)
                   for c in (low, high))
    cells = np.array(list(np.ndindex(*(last - first + 1)))) + first
    while True:
        middle = _positions((cells + 0.5) * size, spacing)
        reach = CELL_RADIUS * size * spacing
        inside = ((middle >= low[:, np.newaxis] - reach)
                  & (middle <= high[:, np.newaxis] + reach)).all(axis=0)
        cells, middle = cells[inside], middle[:, inside]
        cells = cells[np.abs(_evaluated(function, middle)) <= steepness * reach]
        if size == 1:
            return cells
        cells = (2 * cells[:, np.newaxis] + CORNERS).reshape(-1, 3)
        size //= 2
        if size == 1:  # the last halving is left to _mesh, which looks at the signs
            return cells


def _positions(indices: Array, spacing: float) -> Array:
    i, j, k = (spacing / 2 * indices[:, axis] for axis in range(3))
    return np.stack([j + k - i, k + i - j, i + j - k])


def _evaluated(function: Function, points: Array) -> Array:
    values = [function(np.ascontiguousarray(points[:, i:i + CHUNK]))
              for i in range(0, points.shape[1], CHUNK)]
    return np.concatenate(values) if values else np.empty(0)


def _mesh(function: Function, cells: Array, spacing: float, steepness: float) -> Array:
    points, corners = _points_of(cells)
    position = _positions(points, spacing)
    value = _evaluated(function, position)
    inside = (value < 0)[corners]
    corners = corners[inside.any(axis=1) & ~inside.all(axis=1)]
    used = np.zeros(len(value), dtype=bool)
    used[corners] = True
    near = np.flatnonzero(used & (np.abs(value) < CLEARANCE * spacing * steepness))
    position[:, near], value[near] = _given_way(function, position[:, near], value[near], spacing)
    return _marched(corners, position, value)


def _points_of(cells: Array) -> tuple[Array, Array]:
    """The points of cells, each once, and the indices (n, 8) of the cells' corners among them."""
    first = cells.min(axis=0)
    extent = cells.max(axis=0) - first + 2
    corners = cells[:, np.newaxis] - first + CORNERS
    key = (corners[..., 0] * extent[1] + corners[..., 1]) * extent[2] + corners[..., 2]
    keys, index = np.unique(key, return_inverse=True)
    points = np.stack([keys // (extent[1] * extent[2]), keys // extent[2] % extent[1],
                       keys % extent[2]], axis=-1) + first
    return points, index.reshape(key.shape)


def _given_way(function: Function, p: Array, value: Array, spacing: float) -> tuple[Array, Array]:
    """Points that are too close to the surface, moved along the gradient to a clearance."""
    step = 0.1 * spacing
    gradient = np.stack([(_evaluated(function, p + step * np.eye(3)[:, [i]]) - value) / step
                         for i in range(3)])
    slope = np.maximum(_length(gradient), 0.3)
    side = np.where(value < 0, -1, 1)
    move = np.maximum(CLEARANCE * spacing - np.abs(value) / slope, 0) * side
    return p + gradient / slope * move, value + move * slope


def _cases() -> list[list[tuple[int, int, int]]]:
    """For each set of corners inside a tetrahedron, as a binary number: triangles, each of
    three edges (lower, upper corner)."""
    def edge(a: int, b: int) -> tuple[int, int]:
        return min(a, b), max(a, b)

    def even(order: list[int]) -> bool:
        return sum(a > b for i, a in enumerate(order) for b in order[i + 1:]) % 2 == 0

    cases = []
    for mask in range(16):
        inner = [i for i in range(4) if mask >> i & 1]
        outer = [i for i in range(4) if not mask >> i & 1]
        few, many = (inner, outer) if len(inner) <= 2 else (outer, inner)
        flipped = even(few + many) != (few is inner)
        if len(few) == 2:
            (i, j), (k, m) = few, many
            a, b, c, d = edge(i, k), edge(i, m), edge(j, m), edge(j, k)
            triangles = [(a, b, c), (a, c, d)]
        else:
            triangles = [tuple(edge(i, j) for j in many) for i in few]
        cases.append([t[::-1] if flipped else t for t in triangles])
    return cases


CASES = _cases()


def _marched(corners: Array, position: Array, value: Array) -> Array:
    """Each cell is parted into the six tetrahedra along its diagonal."""
    def vertex(tetrahedra: Array, edge: tuple[int, int]) -> Array:
        a, b = tetrahedra[:, edge[0]], tetrahedra[:, edge[1]]
        t = value[a] / (value[a] - value[b])
        return (position[:, a] + t * (position[:, b] - position[:, a])).T

    meshes = [np.empty((0, 3, 3))]
    for order in permutations((4, 2, 1)):
        odd = (order[0] < order[1]) ^ (order[1] < order[2]) ^ (order[0] < order[2])
        path = [0, order[0], order[0] + order[1], 7]
        tetrahedra = corners[:, path]
        inside = (value[tetrahedra] < 0).astype(int)
        mask = inside[:, 0] | inside[:, 1] << 1 | inside[:, 2] << 2 | inside[:, 3] << 3
        for case in range(1, 15):
            crossed = tetrahedra[mask == case]
            for triangle in CASES[case]:
                mesh = np.stack([vertex(crossed, edge) for edge in triangle], axis=1)
                meshes.append(mesh[:, ::-1] if odd else mesh)
    return np.concatenate(meshes)
