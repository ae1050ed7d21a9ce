#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""A path through a wood of oaks, beeches, birches and spruces, with undergrowth.

One unit is half a metre. Foliage gets the triangles that all else leaves of the level of detail.
"""

import numpy as np

from forest_parts import ferns, land, planting, sky, trees, undergrowth
from forest_parts.planting import Nursery, Plant
from model import vectors
from model.generator import Model, run
from model.meshes import joined
from model.portable import power
from model.shapes import steps

Array = np.ndarray

STANDARD = 3.0e6  # triangles
SKY, SUN = 1.2, 680.0  # radiant exitance, the sky's at the zenith
HAZE = 0.7
REFLECTANCE = 0.55


def planted(mesh: Array, plant: Plant) -> Array:
    return vectors.transformed(mesh, plant.matrix()) + plant.position()


def fineness(plant: Plant, detail: float) -> float:
    """Of the wood: 1 for a tree near the eye in the standard scene."""
    return np.sqrt(detail) * 36 / (plant.from_eye() + 10) * (1.0 if plant.in_view() else 0.3)


def wood(plants: list[Plant], nursery: Nursery, detail: float) -> Array:
    return joined([planted(trees.wood(nursery.individual(plant), fineness(plant, detail), i),
                           plant) for i, plant in enumerate(plants)])


def shares(plants: list[Plant]) -> Array:
    """Which part of all leaf triangles each tree gets: more where the eye is near."""
    weight = np.array([plant.species.foliage.area * plant.scale**2 for plant in plants])
    distance = np.array([plant.from_eye() for plant in plants])
    seen = np.array([1.0 if plant.in_view() else 0.12 for plant in plants])
    weight = weight * seen / power(distance + 10, 1.3)
    return weight / np.cumsum(weight)[-1]


def foliage(plants: list[Plant], nursery: Nursery, triangles: float) -> Array:
    meshes = []
    for i, (plant, share) in enumerate(zip(plants, shares(plants).tolist())):
        count, level = trees.leaf_count(plant.species, share * triangles)
        meshes.append(planted(trees.foliage(nursery.individual(plant), count, level, 7000 + i),
                              plant))
    return joined(meshes)


def fallen_stem(detail: float) -> Array:
    start, end = land.on_ground(land.LOG[:, 0], land.LOG[:, 1])
    along = vectors.normalized(end - start)
    across = vectors.normalized(vectors.cross(along, np.array([0, 1.0, 0])))
    log = trees.fallen(float(vectors.length(end - start)), land.LOG_RADIUS,
                       min(160, steps(70 * np.sqrt(detail), 4)),
                       min(400, steps(120 * np.sqrt(detail), 4)))
    return vectors.transformed(log, vectors.frame(along, vectors.cross(across, along), across)
                               ) + start


def floor(budget: float, detail: float) -> Array:
    """The ground, and what lies and grows on it."""
    return joined(land.ground(0.035 * budget), land.stones(detail), fallen_stem(detail),
                  undergrowth.fallen_leaves(0.06 * budget), undergrowth.mushrooms(detail),
                  undergrowth.grass(0.05 * budget, detail), ferns.ferns(0.24 * budget))


def plants_of(detail: float) -> list[Plant]:
    """A small scale makes do with fewer trees, and still fewer bushes."""
    some = min(1.0, 1.6 * float(power(detail, 0.17)))
    wooded = planting.trees()
    shrubs = planting.shrubs(wooded)
    return wooded[:int(some * len(wooded))] + shrubs[:int(some * some * len(shrubs))]


def build(detail: float) -> Model:
    budget = STANDARD * detail
    lights = [(sky.zenith(), SKY), (sky.haze(), HAZE), (sky.sun(), SUN)]
    plants, nursery = plants_of(detail), Nursery()
    solid = joined(floor(budget, detail), wood(plants, nursery, detail))
    spent = len(solid) + sum(len(mesh) for mesh, _ in lights)
    crowns = foliage(plants, nursery, max(0.25 * budget, budget - spent))
    return Model(joined(solid, crowns), lights, REFLECTANCE)


if __name__ == '__main__':
    run(__doc__, build, standard=STANDARD)
