# SPDX-License-Identifier: GPL-3.0-only
"""The species of the wood: their stems, the habit of their shoots, and their leaves."""

from dataclasses import dataclass

import numpy as np

from . import leaves
from .branching import Habit

Array = np.ndarray


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
    (Habit(60, (0.04, 0.99), (85, 80, 70, 45), (0.36, 0.32, 0.2, 0.06), 0.5, 0.15,
           whorl=5, steps=4),
     Habit(9, (0.15, 1.0), (50, 50, 35), (0.36, 0.32, 0.15), 0.05, 0.2, 0.8, steps=3)),
    Foliage(NEEDLE, 0.22, 6.0, 60, 0.0, 52, around=True), 2.6)
