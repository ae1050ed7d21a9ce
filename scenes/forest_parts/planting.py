# SPDX-License-Identifier: GPL-3.0-only
"""Which tree stands where."""

from dataclasses import dataclass

import numpy as np

from model import vectors
from model.noise import gradient_noise
from model.portable import PI, Random

from . import land
from .species import BEECH, BIRCH, HAZEL, OAK, SAPLING, SPRUCE, SPRUCELING, Species
from .trees import Individual, grown

Array = np.ndarray

VARIANTS = 4
CLEARING = (4.0, 12.0, 16.0)  # x, z, radius
EDGE = 70.0
COMPOSED = [  # species, variant, x, z, scale: those that make the picture
    (OAK, 0, -8.5, 27.0, 1.0), (BIRCH, 1, 12.5, 24.0, 1.0), (BIRCH, 2, 14.5, 21.0, 0.85),
    (SPRUCE, 0, 19.0, 6.0, 0.9), (BEECH, 0, -11.0, -7.0, 1.0), (BIRCH, 0, -4.5, -12.0, 0.9),
    (SPRUCELING, 0, 9.5, 14.5, 0.75), (SPRUCELING, 1, -11.0, 19.5, 0.55),
    (HAZEL, 0, 15.0, 29.0, 0.9), (HAZEL, 1, -15.0, 24.0, 1.0), (SAPLING, 0, -5.5, 12.0, 0.8),
    (SAPLING, 1, 11.5, 2.0, 1.0)]


@dataclass
class Plant:
    species: Species
    variant: int
    x: float
    z: float
    scale: float
    turn: float
    lean: Array  # axis times angle

    def from_eye(self) -> float:
        dx, dz = self.x - land.EYE[0], self.z - land.EYE[1]
        return float(np.sqrt(dx * dx + dz * dz))

    def in_view(self) -> bool:
        ahead = land.EYE[1] - self.z
        return ahead > -2 and abs(self.x - land.EYE[0]) < 0.75 * ahead + 8

    def matrix(self) -> Array:
        upright = vectors.rotation(np.array([0, 1.0, 0]), self.turn)
        angle = vectors.length(self.lean)
        tilt = vectors.rotation(vectors.normalized(self.lean), angle)
        return self.scale * vectors.transformed(upright.T, tilt).T

    def position(self) -> Array:
        return land.on_ground(np.array([self.x]), np.array([self.z]))[0]


def _plant(species: Species, variant: int, x: float, z: float, scale: float,
           random: Random) -> Plant:
    draws = random.uniform(-1, 1, 3)
    lean = 0.035 * np.array([float(draws[0]), 0, float(draws[1])])
    return Plant(species, variant, x, z, scale, PI * float(draws[2]), lean)


def _species_at(x: float, z: float, draw: float) -> Species:
    noise = gradient_noise(np.array([[x / 24 + 0.3, 0.5, z / 24]]), 77)
    kind = float(noise[0]) + 0.6 * (draw - 0.5)
    if kind > 0.12:
        return SPRUCE
    if kind > -0.06:
        return BIRCH
    return BEECH if draw < 0.6 else OAK


def _open(x: float, z: float, margin: float) -> bool:
    """Whether the place has to stay free: path, clearing and the view of the camera."""
    ahead = land.EYE[1] - z
    if float(land.beside_path(x, z)) < 1.6 + margin:
        return True
    dx, dz = x - CLEARING[0], z - CLEARING[1]
    if dx * dx + dz * dz < (CLEARING[2] - 2 + margin)**2:
        return True
    return -5 < ahead < 26 and abs(x) < 5 + margin + 0.28 * max(0.0, ahead)


def trees() -> list[Plant]:
    """The composed ones first, then others by throwing darts."""
    random = Random(501)
    plants = [_plant(*place, random) for place in COMPOSED]
    for x, z, draw, size, variant in random.uniform(0, 1, (2600, 5)).tolist():
        x, z = EDGE * (2 * x - 1), EDGE * (2 * z - 1)
        if x * x + z * z > EDGE * EDGE or _open(x, z, 3.0):
            continue
        species = _species_at(x, z, draw)
        if _room(plants, species, x, z):
            plants.append(_plant(species, int(variant * VARIANTS), x, z, 0.72 + 0.4 * size, random))
    return plants


def _room(plants: list[Plant], species: Species, x: float, z: float) -> bool:
    def clear(plant: Plant) -> bool:
        dx, dz = plant.x - x, plant.z - z
        return dx * dx + dz * dz > (0.82 * (plant.species.crown + species.crown))**2
    return all(clear(plant) for plant in plants)


def shrubs(others: list[Plant]) -> list[Plant]:
    """Bushes and young trees between the others."""
    random = Random(503)
    plants: list[Plant] = []
    kinds = (HAZEL, SAPLING, HAZEL, SPRUCELING, SAPLING)
    for x, z, draw, size, variant in random.uniform(0, 1, (900, 5)).tolist():
        z, x = 34 - 96 * z, 62 * (2 * x - 1)
        if x * x + z * z > 68**2 or _open(x, z, 1.0) or len(plants) == 60:
            continue
        species = kinds[int(draw * len(kinds))]
        if _room(plants, species, x, z) and all(
                (p.x - x)**2 + (p.z - z)**2 > 4 for p in others):
            plants.append(_plant(species, int(variant * VARIANTS), x, z, 0.6 + 0.5 * size, random))
    return plants


class Nursery:
    """Grows each individual once."""

    def __init__(self):
        self._grown: dict[tuple[str, int], Individual] = {}

    def individual(self, plant: Plant) -> Individual:
        key = plant.species.name, plant.variant
        if key not in self._grown:
            self._grown[key] = grown(plant.species, plant.variant)
        return self._grown[key]
