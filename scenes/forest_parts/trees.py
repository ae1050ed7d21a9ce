# SPDX-License-Identifier: GPL-3.0-only
"""Individual trees, and the triangles of their wood and of their leaves."""

from dataclasses import dataclass

import numpy as np

from model import vectors
from model.meshes import joined
from model.noise import fractal_noise, gradient_noise
from model.portable import PI, Random, cos, exp, sin
from model.shapes import steps, surface, tubes

from . import leaves
from .branching import UP, Shoots, leader, profile, sprung
from .species import Bark, Foliage, Species

Array = np.ndarray
ROOT_DEPTH = 1.5  # so deep the stem goes into the ground
LONGEST_LEAF = 9.0  # where few leaves stand for a whole crown
THINNEST_LEAF = 0.012


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
    rough = 0.35 * fractal_noise(places * 2.3, 2, seed + 3)
    relief = bark.relief * (ridges + rough) + 0.09 * swells
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
    bend = 0.022 * length * sin(np.arange(n) / 8)
    path = np.stack([bend, length * np.arange(n) / (n - 1), 0.7 * bend], axis=-1)
    log = stem(path, radii, Bark(0.15, 2.6, 4.0, 0.0), sides, rows, 5)
    log = joined(log, _stubs(path, radius, max(3, sides // 4)))
    return np.stack([log[..., 1], 0.72 * radius - log[..., 0], log[..., 2]], axis=-1)


def _stubs(path: Array, radius: float, sides: int) -> Array:
    """What is left of the limbs of a fallen stem, broken off."""
    base = path[[11, 21, 33]]
    aim = np.array([[-1.5, 0.9, 0.5], [-0.7, 0.8, -1.2], [-1.0, 0.5, 0.7]])
    reach = radius * np.array([1.7, 2.0, 1.3])[:, np.newaxis]
    paths = np.stack([base, base + 0.6 * reach * aim, base + reach * (aim + (0.1, 0.3, 0))], axis=1)
    return tubes(paths, radius * np.array([0.36, 0.25, 0.17]), sides)


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
    kind = species.foliage
    natural = kind.area * kind.slenderness / (leaves.area(kind.blades[0][0]) * kind.length**2)
    counts = [int(triangles / len(blades[0])) for blades in kind.blades]
    level = max([level for level, count in enumerate(counts) if count > 0.35 * natural], default=0)
    return max(1, counts[level]), level


def foliage(tree: Individual, count: int, level: int, seed: int) -> Array:
    """So many leaves, whose common area is that of the species."""
    kind = tree.species.foliage
    draws = Random(seed).uniform(0, 1, (count, 8))
    base, along, aside = _stalks(tree, draws[:, :2])
    stray = draws[:, 2:5] * 2 - 1
    angle = kind.spread * (PI / 180) * (0.6 + 0.8 * draws[:, 5:6])
    direction = vectors.normalized(cos(angle) * along + sin(angle) * aside + 0.35 * stray)
    upper = kind.light * UP + 0.9 * (draws[:, 5:8] * 2 - 1) + (kind.around * 0.7) * stray[:, ::-1]
    blades = kind.blades[level]
    length, width = _leaf_size(kind, blades[0], count)
    variation = 0.65 + 0.7 * draws[:, 6]
    matrices = leaves.frames(direction, upper, length * variation, width * variation)
    return leaves.strewn(blades, matrices, base)


def _stalks(tree: Individual, draws: Array) -> tuple[Array, Array, Array]:
    """Where leaves stand, along which twig, and to which side; the first ones on all twigs."""
    twigs, number = tree.orders[-1], np.arange(len(draws))
    share = number * ((np.sqrt(5.0) - 1) / 2)
    twig = ((share - np.floor(share)) * len(twigs.paths)).astype(np.int64)
    base, along, _ = Shoots(twigs.paths[twig], twigs.radii[twig]).at(
        1 - draws[:, :1] * (1 - 0.25 * draws[:, :1]))
    base, along = base[:, 0], along[:, 0]
    aside = vectors.normalized(vectors.cross(along, UP) + 1e-3 * np.array([1.0, 0, 0.3]))
    if not tree.species.foliage.around:
        return base, along, aside * np.where(number % 2, 1, -1)[:, np.newaxis]
    turn = (2 * PI * draws[:, 1])[:, np.newaxis]
    return base, along, cos(turn) * aside + sin(turn) * vectors.cross(aside, along)


def _leaf_size(kind: Foliage, blade: Array, count: int) -> tuple[float, float]:
    """Length and width: fewer leaves are larger, so that the crown stays as dense."""
    unit = leaves.area(blade)
    each = kind.area / count
    longest = 5 * kind.length if kind.around else LONGEST_LEAF
    length = min(longest, np.sqrt(each * kind.slenderness / unit))
    return length, min(max(each / (unit * length), THINNEST_LEAF), 1.1 * length)
