# SPDX-License-Identifier: GPL-3.0-only
"""How shoots spring from shoots: the skeletons of trees and bushes."""

from dataclasses import dataclass

import numpy as np

from model import vectors
from model.portable import PI, Random, cos, sin

Array = np.ndarray
UP = np.array([0, 1.0, 0])
GOLDEN_ANGLE = PI * (3 - np.sqrt(5.0))
CHILDREN = 0.92  # of a shoot's cross section passes into its children (Leonardo's rule)
THINNEST = 0.008


@dataclass(frozen=True)
class Habit:
    """How the shoots of one order stand on those of the order before.

    Profiles run from the first to the last child along the parent.
    """
    count: int
    span: tuple[float, float]  # of the parent's length, where its children stand
    angle: tuple[float, ...]  # profile of the degrees between parent and child
    length: tuple[float, ...]  # profile, in lengths of the parent
    rise: float = 0.0  # bends towards the light, or droops where negative
    wander: float = 0.2
    flatness: float = 0.0  # 1: sprays in a horizontal plane
    whorl: int = 1  # so many children stand at the same height
    steps: int = 5


@dataclass
class Shoots:
    paths: Array  # (n, points, 3)
    radii: Array  # (n, points)

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """Positions, directions and radii at parameters (n, k)."""
        last = self.paths.shape[1] - 2
        span = np.clip((t * (last + 1)).astype(np.int64), 0, last)
        rest = (t * (last + 1) - span)[..., np.newaxis]
        own = np.arange(len(t))[:, np.newaxis]
        start, end = self.paths[own, span], self.paths[own, span + 1]
        share = rest[..., 0]
        radius = self.radii[own, span] * (1 - share) + self.radii[own, span + 1] * share
        return start + rest * (end - start), vectors.normalized(end - start), radius

    def lengths(self) -> Array:
        ends = self.paths[:, -1] - self.paths[:, 0]
        return vectors.length(ends)


def profile(values: tuple[float, ...], t: Array) -> Array:
    """Piecewise linear through evenly spaced values."""
    values = np.array(values)
    if len(values) == 1:
        return np.full_like(t, values[0])
    span = np.clip((t * (len(values) - 1)).astype(np.int64), 0, len(values) - 2)
    rest = t * (len(values) - 1) - span
    return values[span] * (1 - rest) + values[span + 1] * rest


def wandering(start: Array, direction: Array, length: Array, habit: Habit, random: Random) -> Array:
    """Paths that bend upwards or downwards and stray a little at each step."""
    points = [start]
    stray = random.normal((habit.steps, len(start), 3))
    for i in range(habit.steps):
        direction = vectors.normalized(direction + (habit.rise / habit.steps) * UP
                                       + habit.wander * stray[i] / np.sqrt(habit.steps))
        points.append(points[-1] + direction * (length / habit.steps)[:, np.newaxis])
    return np.stack(points, axis=1)


def tapered(base: Array, points: int, bare: float = 0.0) -> Array:
    """Radii along shoots that give away their cross section beyond their bare part."""
    t = np.clip((np.arange(points) / (points - 1) - bare) / (1 - bare), 0, 1)
    return np.maximum(THINNEST, base[:, np.newaxis] * np.sqrt(1 - CHILDREN * t))


def leader(height: float, radius: float, bare: float, wander: float, random: Random) -> Shoots:
    """The stem of a tree."""
    habit = Habit(1, (0, 1), (0,), (1,), rise=0.5, wander=wander, steps=14)
    lean = UP + 0.05 * random.normal(3)
    path = wandering(np.zeros((1, 3)), vectors.normalized(lean)[np.newaxis], np.array([height]),
                     habit, random)
    return Shoots(path, tapered(np.array([radius]), habit.steps + 1, bare))


def sprung(parents: Shoots, habit: Habit, random: Random) -> Shoots:
    """The children of all parents."""
    n, k = len(parents.paths), habit.count
    draws = random.uniform(0, 1, (n, k, 4))
    order = np.arange(k) // habit.whorl
    at = np.minimum((order + draws[..., 0]) * habit.whorl / k, 1)
    low, high = habit.span
    base, along, radius = parents.at(low + (high - low) * at)
    turn = (np.arange(k) * (GOLDEN_ANGLE if habit.whorl == 1 else 2 * PI / habit.whorl)
            + order * GOLDEN_ANGLE * (habit.whorl > 1) + 0.8 * draws[..., 1]
            + 2 * PI * random.uniform(0, 1, (n, 1)))
    first = vectors.perpendicular(along)
    second = vectors.cross(along, first)
    outwards = cos(turn)[..., np.newaxis] * first + sin(turn)[..., np.newaxis] * second
    angle = profile(habit.angle, at) * (0.8 + 0.4 * draws[..., 2]) * (PI / 180)
    direction = cos(angle)[..., np.newaxis] * along + sin(angle)[..., np.newaxis] * outwards
    direction = vectors.normalized(direction * np.array([1, 1 - 0.8 * habit.flatness, 1]))
    length = (parents.lengths()[:, np.newaxis] * profile(habit.length, at)
              * (0.7 + 0.6 * draws[..., 3]))
    share = np.sqrt(CHILDREN / k) * parents.radii[:, :1]
    child_radius = np.minimum(0.75 * radius, share * (0.7 + 0.6 * draws[..., 3]))
    paths = wandering(base.reshape(-1, 3), direction.reshape(-1, 3), length.reshape(-1), habit,
                      random)
    return Shoots(paths, tapered(child_radius.reshape(-1), habit.steps + 1))
