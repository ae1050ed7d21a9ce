#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""The teapot in the stadium: a tiny, finely tessellated thing on the floor of a huge, simple hall.

A unit is 1.3 m. The pitch lies in the plane y = 0 about the origin, its length along x.
"""

import numpy as np

from model.generator import Model, run
from model.meshes import joined
from model.portable import Random
from model.shapes import steps
from stadium_parts import plan
from stadium_parts.pitch import pitch
from stadium_parts.roof import roof
from stadium_parts.scoreboard import scoreboards
from stadium_parts.seats import coarseness, seats
from stadium_parts.sky import sky
from stadium_parts.stands import directions, stands, tiers
from stadium_parts.teaset import teaset

REFLECTANCE = 0.6  # light that goes round and round would wash out the shadows
SEATS_FROM, FURNITURE_FROM = 0.006, 0.05  # levels of detail; below there are only steps


def ring_directions(fineness: float, furnished: bool) -> np.ndarray:
    """Where the rings of the stadium have corners."""
    if furnished:
        return directions(steps(2 * fineness, 1))
    return plan.evenly(4 * steps(90 * fineness, 3))


def build(detail: float) -> Model:
    fineness = detail**0.5  # triangles along a line
    furnished = detail > FURNITURE_FROM
    angles = ring_directions(fineness, furnished)
    both = tiers(coarseness(detail), furnished)
    parts = [teaset(fineness), pitch(angles, fineness), roof(angles, fineness),
             stands(both, angles, furnished)]
    if furnished:
        parts.append(scoreboards())
    if detail > SEATS_FROM:
        random = Random(1975)
        parts += [seats(tier, detail, random) for tier in both]
    return Model(joined(parts), sky(), REFLECTANCE)


if __name__ == '__main__':
    run(__doc__, build)
