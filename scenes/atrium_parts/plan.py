# SPDX-License-Identifier: GPL-3.0-only
"""The measures that all parts share, and where on the four sides of the court things stand."""

import numpy as np

from model.meshes import repeated

Array = np.ndarray
Stations = tuple[Array, Array]  # matrices (n, 3, 3) and offsets (n, 3), for meshes.repeated()

BAY = 3.4
LONG_BAYS, SHORT_BAYS = 7, 3
HALF_X, HALF_Z = LONG_BAYS * BAY / 2, SHORT_BAYS * BAY / 2  # to the axes of the columns

WALL = 0.28  # half the thickness of the walls above the arches
BACK = 3.2  # from the axes of the columns to the wall behind the walk
OUTSIDE = 3.75  # to the outer face of the building

WALK = 0.34  # the floor of the walk above that of the court
SPRING = 3.46
ARCH = 1.38  # radius
STRING_COURSE = 5.05
GALLERY = 5.5  # the floor of the gallery
RAIL = 6.58  # upper edge of the balustrade
UPPER_SPRING = 8.14
UPPER_ARCH = 0.66
ENTABLATURE = 8.96
CEILING = 9.1  # of the gallery
EAVES = 9.72
RIDGE = 11.3

_TURNS = np.array([[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                   [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
                   [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
                   [[0, 0, -1], [0, 1, 0], [1, 0, 0]]], dtype=float)
SIDES = range(4)  # +z, +x, -z, -x
LONG_SIDES = (0, 2)


def half_length(side: int) -> float:
    return HALF_X if side in LONG_SIDES else HALF_Z


def depth(side: int) -> float:
    return HALF_Z if side in LONG_SIDES else HALF_X


def stations(side: int, u: Array, y: Array | float = 0, w: Array | float = 0) -> Stations:
    """Places on one side of the court, where u is measured from its middle."""
    u, y, w = np.broadcast_arrays(np.asarray(u, dtype=float), y, w)
    local = np.stack([u, y, w + depth(side)], axis=-1).reshape(-1, 3)
    turn = _TURNS[side]
    offsets = local[:, :1] * turn[:, 0] + local[:, 1:2] * turn[:, 1] + local[:, 2:] * turn[:, 2]
    return np.broadcast_to(turn, (len(offsets), 3, 3)), offsets


def united(places: list[Stations]) -> Stations:
    return tuple(np.concatenate(parts) for parts in zip(*places))


def evenly(spacing: float, inset: float = 0, y: float = 0, w: float = 0) -> Stations:
    """Places in the middles of equal spans of all four sides, whose ends are inset."""
    places = []
    for side in SIDES:
        half = half_length(side) - inset
        count = int(2 * half / spacing + 0.5)
        places.append(stations(side, (np.arange(count) + 0.5) * (2 * half / count) - half, y, w))
    return united(places)


def between(spacing: float) -> Stations:
    """Places where the spans of evenly() meet, without the corners of the court."""
    places = []
    for side in SIDES:
        count = int(2 * half_length(side) / spacing + 0.5)
        places.append(stations(side, np.arange(1, count) * spacing - half_length(side)))
    return united(places)


def corners() -> Stations:
    return united([stations(side, [half_length(side)]) for side in SIDES])


def placed(mesh: Array, places: Stations) -> Array:
    return repeated(mesh, *places)
