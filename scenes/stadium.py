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
from stadium_parts.seats import seats
from stadium_parts.sky import sky
from stadium_parts.stands import directions, stands, tiers
from stadium_parts.teaset import teaset

Array = np.ndarray


def build(detail: float) -> Model:
    fineness = detail**0.5
    angles = directions(2)
    random = Random(1975)
    parts = [teaset(fineness), pitch(angles, fineness), roof(angles, fineness), stands(1, 2, True)]
    parts += [seats(tier, 1, (3, 6), random) for tier in tiers(1)]
    return Model(joined(parts), sky())


if __name__ == '__main__':
    run(__doc__, build)
