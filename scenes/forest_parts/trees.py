# SPDX-License-Identifier: GPL-3.0-only
"""The species of the wood, their individuals, and the triangles of one of them."""

from dataclasses import dataclass

import numpy as np

from model import vectors
from model.meshes import joined
from model.noise import fractal_noise, gradient_noise
from model.portable import PI, Random, cos, exp, sin
from model.shapes import steps, surface, tubes

from . import leaves
from .branching import UP, Habit, Shoots, leader, profile, sprung, tapered, wandering

Array = np.ndarray
ROOT_DEPTH = 1.5  # so deep the stem goes into the ground


@dataclass(frozen=True)
class Bark:
    relief: float  # in radii
    ridges: float  # across the stem, to the unit
    stretch: float  # of the ridges along the stem; below 1: rings around it
    flare: float  # of the roots, in radii


@dataclass(frozen=True)
class Foliage:
    blades: tuple[list[Array], ...]  # from coarse to fine
    length: float  # of a leaf
    slenderness: float  # length by width, both as factors of the blade
    area: float  # of all leaves of one tree
    light: float  # how much the upper sides turn to the sky
    spread: float  # degrees between twig and leaf
    around: bool = False  # leaves stand all around the twig, not to both sides


@dataclass(frozen=True)
class Species:
    name: str
    seed: int
    height: float
    radius: float
    bare: float
    wander: float
    bark: Bark | None  # None: many stems from the ground
    habits: tuple[Habit, ...]
    foliage: Foliage
    crown: float  # radius, for the distance from others


BROAD = ([leaves.simple_blade(0.5, 0.30, 0.35), leaves.simple_blade(0.45, 0.33, 0.6)],
         [leaves.blade([(0.45, 0.30)], 0.4, 0.15), leaves.blade([(0.5, 0.32)], 0.2, 0.3),
          leaves.blade([(0.4, 0.28)], 0.7, 0.05)],
         [leaves.blade([(0.25, 0.22), (0.62, 0.27)], 0.4, 0.15),
          leaves.blade([(0.3, 0.25), (0.6, 0.27)], 0.2, 0.32),
          leaves.blade([(0.22, 0.24), (0.65, 0.22)], 0.6, 0.05)])
NEEDLE = ([np.array([[(0, -0.5, 0), (1, 0, 0), (0, 0.5, 0)]], dtype=float)],)

OAK = Species(
    'oak', 11, 38, 1.15, 0.3, 0.35, Bark(0.13, 2.6, 5.0, 0.9),
    (Habit(11, (0.40, 1.0), (85, 75, 50, 25), (0.38, 0.46, 0.40, 0.28), 0.7, 0.75, steps=8),
     Habit(9, (0.3, 1.0), (65, 55, 30), (0.42, 0.42, 0.30), 0.4, 0.6, 0.3),
     Habit(9, (0.35, 1.0), (60, 50, 25), (0.38, 0.38, 0.38), 0.2, 0.5, 0.4, steps=3)),
    Foliage(BROAD, 0.36, 1.0, 600, 1.0, 50), 9.0)
BEECH = Species(
    'beech', 23, 44, 0.85, 0.35, 0.16, Bark(0.025, 0.7, 0.5, 0.7),
    (Habit(16, (0.40, 1.0), (80, 65, 45, 20), (0.26, 0.32, 0.26, 0.14), 0.25, 0.3, steps=7),
     Habit(10, (0.15, 1.0), (60, 50, 30), (0.5, 0.45, 0.3), -0.05, 0.35, 0.75),
     Habit(7, (0.15, 1.0), (55, 45, 20), (0.5, 0.5, 0.5), -0.05, 0.35, 0.85, steps=3)),
    Foliage(BROAD, 0.30, 1.0, 520, 1.6, 48), 7.5)
BIRCH = Species(
    'birch', 37, 36, 0.42, 0.3, 0.24, Bark(0.05, 1.4, 0.35, 0.5),
    (Habit(18, (0.38, 1.0), (60, 50, 40, 25), (0.22, 0.26, 0.22, 0.14), 0.5, 0.35, steps=6),
     Habit(9, (0.2, 1.0), (60, 55, 35), (0.5, 0.5, 0.45), -1.3, 0.4, steps=6),
     Habit(6, (0.1, 1.0), (45, 35, 20), (0.5, 0.5, 0.5), -1.6, 0.4, steps=4)),
    Foliage(BROAD, 0.2, 0.8, 240, 0.3, 65), 5.0)
SPRUCE = Species(
    'spruce', 53, 42, 0.75, 0.1, 0.05, Bark(0.08, 2.2, 1.0, 0.6),
    (Habit(120, (0.18, 0.995), (105, 100, 90, 70, 40), (0.17, 0.19, 0.15, 0.09, 0.02), 0.55, 0.12,
           whorl=5, steps=6),
     Habit(13, (0.12, 1.0), (55, 55, 40), (0.36, 0.34, 0.12), -0.35, 0.2, 0.85, steps=3)),
    Foliage(NEEDLE, 0.28, 6.0, 380, 0.0, 52, around=True), 5.5)
HAZEL = Species(
    'hazel', 71, 1.0, 0.16, 0.0, 0.2, None,
    (Habit(9, (0.0, 0.3), (26,), (7.5, 6.0, 5.0), 0.25, 0.35, steps=7),
     Habit(8, (0.15, 1.0), (50, 40, 25), (0.45, 0.4, 0.3), 0.1, 0.35, 0.3),
     Habit(4, (0.2, 1.0), (55, 45, 20), (0.5, 0.5, 0.5), 0.0, 0.35, 0.5, steps=3)),
    Foliage(BROAD, 0.26, 0.85, 110, 1.3, 50), 2.6)
SAPLING = Species(
    'sapling', 83, 9, 0.09, 0.1, 0.3, Bark(0.02, 2.0, 1.0, 0.1),
    (Habit(14, (0.15, 1.0), (65, 55, 30), (0.34, 0.36, 0.2), 0.2, 0.35, 0.3),
     Habit(7, (0.15, 1.0), (55, 45, 20), (0.45, 0.4, 0.3), 0.0, 0.35, 0.8, steps=3)),
    Foliage(BROAD, 0.26, 1.0, 60, 1.6, 48), 2.2)
SPRUCELING = Species(
    'spruceling', 97, 8, 0.14, 0.0, 0.06, Bark(0.02, 2.0, 1.0, 0.1),
    (Habit(60, (0.04, 0.99), (85, 80, 70, 45), (0.36, 0.32, 0.2, 0.06), 0.5, 0.15, whorl=5, steps=4),
     Habit(9, (0.15, 1.0), (50, 50, 35), (0.36, 0.32, 0.15), 0.05, 0.2, 0.8, steps=3)),
    Foliage(NEEDLE, 0.22, 6.0, 60, 0.0, 52, around=True), 2.6)


@dataclass
class Individual:
    """The skeleton of a tree: stem, limbs, branches, twigs."""
    species: Species
    orders: list[Shoots]


def grown(species: Species, variant: int) -> Individual:
    random = Random(1000 * species.seed + variant)
    size = 0.9 + 0.2 * float(random.uniform(0, 1))
    orders = [leader(species.height * size, species.radius * size, species.bare, species.wander,
                     random)]
    for habit in species.habits:
        orders.append(sprung(orders[-1], habit, random))
    return Individual(species, orders)


def stem(path: Array, radii: Array, bark: Bark, sides: int, rows: int, seed: int) -> Array:
    """An upright stem with relief, and with roots where it leaves the ground."""
    t = np.arange(rows + 1) / rows
    t = t * (0.45 + 0.55 * t)  # finer near the ground
    center = np.stack([profile(tuple(path[:, i]), t) for i in range(3)], axis=-1)
    radius = profile(tuple(radii), t)
    center[:, 1] -= ROOT_DEPTH * (1 - t)
    angle = np.arange(sides) * (-2 * PI / sides)
    ring = np.stack([cos(angle), np.zeros(sides), sin(angle)], axis=-1)[:, np.newaxis]
    above = np.maximum(0, center[:, 1])
    roots = exp(-above / (1.6 * radii[0])) * bark.flare
    lobes = 0.45 + 0.55 * np.abs(sin(2.5 * angle + 1.7 * seed))[:, np.newaxis]
    places = ring * bark.ridges + center * np.array([0, bark.ridges / bark.stretch, 0]) + 9.1 * seed
    ridges = 1 - 2.6 * np.abs(gradient_noise(places, seed))
    swells = fractal_noise(ring * 0.8 + center * 0.25, 2, seed + 7)
    relief = bark.relief * (ridges + 0.35 * fractal_noise(places * 2.3, 2, seed + 3)) + 0.09 * swells
    return surface(center + ring * (radius * (1 + roots * lobes + relief))[..., np.newaxis],
                   closed_u=True)


def wood(tree: Individual, fineness: float, seed: int) -> Array:
    """Fineness 1 shows bark and every twig."""
    parts, species = [], tree.species
    first = tree.orders[0]
    if species.bark:
        sides = min(160, steps(75 * fineness * np.sqrt(species.radius), 3))
        rows = min(500, steps(100 * fineness * fineness * np.sqrt(species.height / 38), 1))
        parts.append(stem(first.paths[0], first.radii[0], species.bark, sides, rows, seed))
    for order, least, sides in ((1, 0.08, 8), (2, 0.22, 5), (3, 0.45, 3)):
        if order < len(tree.orders) and fineness >= least:
            parts.append(branches(tree.orders[order], fineness, sides))
    return joined(parts)


def fallen(length: float, radius: float, sides: int, rows: int) -> Array:
    """A log along +x that rests on the ground at y = 0, its ends broken off blunt."""
    n = 41
    radii = radius * (1 - 0.35 * np.arange(n) / n)
    radii[0] = radii[-1] = 0.05 * radius
    bend = 0.012 * length * sin(np.arange(n) / 9)
    path = np.stack([bend, length * np.arange(n) / (n - 1), 0.7 * bend], axis=-1)
    log = stem(path, radii, Bark(0.09, 2.6, 5.0, 0.0), sides, rows, 5)
    return np.stack([log[..., 1], 0.72 * radius - log[..., 0], log[..., 2]], axis=-1)


def branches(shoots: Shoots, fineness: float, sides: int) -> Array:
    points = shoots.paths.shape[1]
    kept = max(2, min(points, steps(points * fineness * 1.2, 2)))
    at = (np.arange(kept) * (points - 1)) // (kept - 1)
    return tubes(shoots.paths[:, at], shoots.radii[:, at],
                 int(max(3, min(24, sides * fineness))), closed_ends=False)


def leaf_count(species: Species, triangles: float) -> tuple[int, int]:
    """How many leaves, and at which level of their blades, so many triangles make.

    Finer blades come before leaves that are much smaller than in nature.
    """
    habit = species.foliage
    natural = habit.area * habit.slenderness / (leaves.area(habit.blades[0][0]) * habit.length**2)
    for level in reversed(range(len(habit.blades))):
        count = triangles / len(habit.blades[level][0])
        if count > 0.35 * natural or level == 0:
            return max(1, int(count)), level
    raise AssertionError


def foliage(tree: Individual, count: int, level: int, seed: int) -> Array:
    """So many leaves, whose common area is that of the species."""
    habit, twigs = tree.species.foliage, tree.orders[-1]
    draws = Random(seed).uniform(0, 1, (count, 8))
    number = np.arange(count)
    share = number * ((np.sqrt(5.0) - 1) / 2)
    twig = ((share - np.floor(share)) * len(twigs.paths)).astype(np.int64)
    base, along, _ = Shoots(twigs.paths[twig], twigs.radii[twig]).at(
        1 - draws[:, :1] * (1 - 0.25 * draws[:, :1]))
    base, along = base[:, 0], along[:, 0]
    aside = vectors.normalized(vectors.cross(along, UP) + 1e-3 * np.array([1.0, 0, 0.3]))
    if habit.around:
        turn = (2 * PI * draws[:, 1])[:, np.newaxis]
        aside = cos(turn) * aside + sin(turn) * vectors.cross(aside, along)
    else:
        aside = aside * np.where(number % 2, 1, -1)[:, np.newaxis]
    stray = draws[:, 2:5] * 2 - 1
    angle = habit.spread * (PI / 180) * (0.6 + 0.8 * draws[:, 5:6])
    direction = vectors.normalized(cos(angle) * along + sin(angle) * aside + 0.35 * stray)
    upper = habit.light * UP + 0.9 * (draws[:, 5:8] * 2 - 1) + (habit.around * 0.7) * stray[:, ::-1]
    blades = habit.blades[level]
    length, width = leaf_size(habit, blades[0], count)
    variation = 0.65 + 0.7 * draws[:, 6]
    matrices = leaves.frames(direction, upper, length * variation, width * variation)
    return leaves.strewn(blades, matrices, base)


def leaf_size(habit: Foliage, blade: Array, count: int) -> tuple[float, float]:
    """Fewer leaves are larger, so that the crown stays as dense."""
    unit = leaves.area(blade)
    each = habit.area / count
    length = min(4.0, np.sqrt(each * habit.slenderness / unit))
    length = min(length, habit.length * 5) if habit.around else length
    return length, min(max(each / (unit * length), 0.012), length * 1.1)
