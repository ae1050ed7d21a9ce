#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""The statue of an owl in a niche: one closed, finely tessellated surface in a hall."""

import numpy as np

from model.generator import Model, run
from model.meshes import Y, joined, moved, rotated, scaled
from statue_parts.owl import ROCK_BOTTOM, owl
from statue_parts.room import NICHE_FLOOR, pedestal, room, window

SPACING = 0.0715  # of the owl's lattice
SIZE = 1.2  # of the owl
PEDESTAL_HEIGHT = 6.2
STATUE_Z = -0.5
TURN = 0.1  # radians: the owl's breast faces away from the window a little
EXITANCE = 20


def build(detail: float) -> Model:
    bird = owl(SPACING / np.sqrt(detail))
    top = NICHE_FLOOR + PEDESTAL_HEIGHT
    bird = rotated(scaled(bird, SIZE), Y, TURN)
    bird = moved(bird, y=top - SIZE * ROCK_BOTTOM - 0.05, z=STATUE_Z)
    base = moved(joined(pedestal(PEDESTAL_HEIGHT, detail)), y=NICHE_FLOOR, z=STATUE_Z)
    return Model(joined(bird, base, room(detail)), lights=[(window(), EXITANCE)], reflectance=0.5)


if __name__ == '__main__':
    run(__doc__, build)
