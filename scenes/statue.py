#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""The statue of an owl in a niche: one closed, finely tessellated surface in a hall."""

import numpy as np

from model.generator import Model, run
from model.meshes import Y, joined, moved, rotated
from statue_parts.owl import ROCK_BOTTOM, owl
from statue_parts.room import NICHE_FLOOR, pedestal, room, window

SPACING = 0.0715  # of the owl's lattice
PEDESTAL_HEIGHT = 8.6
STATUE_Z = -0.5
TURN = -0.16  # radians: the owl's breast faces the window a little
EXITANCE = 10


def build(detail: float) -> Model:
    bird = owl(SPACING / np.sqrt(detail))
    top = NICHE_FLOOR + PEDESTAL_HEIGHT
    bird = moved(rotated(bird, Y, TURN), y=top - ROCK_BOTTOM - 0.05, z=STATUE_Z)
    base = moved(joined(pedestal(PEDESTAL_HEIGHT, detail)), y=NICHE_FLOOR, z=STATUE_Z)
    return Model(joined(bird, base, room(detail)), lights=[(window(), EXITANCE)], reflectance=0.6)


if __name__ == '__main__':
    run(__doc__, build)
