# SPDX-License-Identifier: GPL-3.0-only
"""How finely to model."""

import math
from dataclasses import dataclass

import numpy as np

from model.shapes import simplified, steps

Array = np.ndarray
TOLERANCE = 0.0016  # by which an outline may be off at the standard level
COARSEST = 0.12
MASSES = 0.004  # below this level there are but the main masses
BOW_SAMPLES = 256  # of which an outline keeps those that it needs


@dataclass(frozen=True)
class Level:
    """A level of detail: about the number of triangles relative to the standard scene."""

    detail: float

    def segments(self, ideal: float, least: int = 1) -> int:
        """How many segments to give to what has an ideal number of them at the standard level."""
        return steps(ideal * math.sqrt(self.detail), least)

    @property
    def coarse(self) -> bool:
        return self.detail < MASSES

    def has(self, detail: float) -> bool:
        return self.detail >= detail

    def outline(self, knots: list[tuple]) -> Array:
        """A profile (n, 2) through knots (x, y) or (x, y, bow), with as many points as it needs.

        The line to a knot with a bow is a parabola whose height is `bow` times its chord, to the
        right of the way if the bow is positive: where the profile runs upwards, that is outside.
        """
        return simplified(_bent(knots), min(TOLERANCE / self.detail, COARSEST))


def _bent(knots: list[tuple]) -> Array:
    points = [np.array([knots[0][:2]], dtype=float)]
    for (x0, y0, *_), (x1, y1, *bow) in zip(knots, knots[1:]):
        count = BOW_SAMPLES if bow else 1
        t = np.arange(1, count + 1) / count
        height = 4 * t * (1 - t) * (bow[0] if bow else 0)
        points.append(np.stack([x0 + (x1 - x0) * t + (y1 - y0) * height,
                                y0 + (y1 - y0) * t - (x1 - x0) * height], axis=-1))
    return np.concatenate(points)
