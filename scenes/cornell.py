#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""The Cornell box with its two blocks.

Measures are those that Cornell University publishes, in units of 100 mm. The light lies in a hole
of the ceiling, so that no two triangles cover each other.
"""

import numpy as np

from model.generator import Model, run
from model.shapes import quad

Point = tuple[float, float, float]

WIDTH, HEIGHT, DEPTH = 552.8, 548.8, 559.2
LIGHT_X, LIGHT_Z = (213.0, 343.0), (227.0, 332.0)
SHORT_BLOCK = 165.0, [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)]
TALL_BLOCK = 330.0, [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)]


def rectangle(x: tuple[float, float], y: float, z: tuple[float, float]) -> list[Point]:
    return [(x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1])]


def light() -> np.ndarray:
    return quad(*rectangle(LIGHT_X, HEIGHT, LIGHT_Z))


def room() -> list[np.ndarray]:
    floor = rectangle((0, WIDTH), 0, (0, DEPTH))
    ceiling = rectangle((0, WIDTH), HEIGHT, (0, DEPTH))
    hole = rectangle(LIGHT_X, HEIGHT, LIGHT_Z)
    quads = [quad(*floor)]
    for i in range(4):
        following = (i + 1) % 4
        quads.append(quad(ceiling[i], ceiling[following], hole[following], hole[i]))
    for i in range(1, 4):  # the side from which the camera looks in is open
        following = (i + 1) % 4
        quads.append(quad(floor[i], floor[following], ceiling[following], ceiling[i]))
    return quads


def block(height: float, corners: list[tuple[float, float]]) -> list[np.ndarray]:
    bottom = [(x, 0.0, z) for x, z in corners]
    top = [(x, height, z) for x, z in corners]
    quads = [quad(*top)]
    for i in range(4):
        following = (i + 1) % 4
        quads.append(quad(bottom[i], bottom[following], top[following], top[i]))
    return quads


def build(_: float) -> Model:
    geometry = np.concatenate(room() + block(*SHORT_BLOCK) + block(*TALL_BLOCK))
    return Model(geometry / 100, lights=[(light() / 100, 80)])


if __name__ == '__main__':
    run(__doc__, build, scalable=False)
