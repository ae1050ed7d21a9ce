#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Writes cornell.ra2: the Cornell box with its two blocks.

Measures are those that Cornell University publishes, in units of 100 mm. The light lies in a hole
of the ceiling, so that no two triangles cover each other. Its two triangles come first.
"""

import struct
import sys

Point = tuple[float, float, float]

WIDTH, HEIGHT, DEPTH = 552.8, 548.8, 559.2
LIGHT_X, LIGHT_Z = (213.0, 343.0), (227.0, 332.0)
SHORT_BLOCK = 165.0, [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)]
TALL_BLOCK = 330.0, [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)]


def quad(a: Point, b: Point, c: Point, d: Point) -> list[tuple[Point, Point, Point]]:
    return [(a, b, c), (a, c, d)]


def rectangle(x: tuple[float, float], y: float, z: tuple[float, float]) -> list[Point]:
    return [(x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1])]


def room() -> list[tuple[Point, Point, Point]]:
    floor = rectangle((0, WIDTH), 0, (0, DEPTH))
    ceiling = rectangle((0, WIDTH), HEIGHT, (0, DEPTH))
    light = rectangle(LIGHT_X, HEIGHT, LIGHT_Z)
    triangles = quad(*light) + quad(*floor)
    for i in range(4):
        following = (i + 1) % 4
        triangles += quad(ceiling[i], ceiling[following], light[following], light[i])
    for i in range(1, 4):  # the side from which the camera looks in is open
        following = (i + 1) % 4
        triangles += quad(floor[i], floor[following], ceiling[following], ceiling[i])
    return triangles


def block(height: float, corners: list[tuple[float, float]]) -> list[tuple[Point, Point, Point]]:
    bottom = [(x, 0.0, z) for x, z in corners]
    top = [(x, height, z) for x, z in corners]
    triangles = quad(*top)
    for i in range(4):
        following = (i + 1) % 4
        triangles += quad(bottom[i], bottom[following], top[following], top[i])
    return triangles


def main(path: str) -> None:
    triangles = room() + block(*SHORT_BLOCK) + block(*TALL_BLOCK)
    with open(path, 'wb') as file:
        for triangle in triangles:
            file.write(struct.pack('<9f', *(value / 100 for point in triangle for value in point)))


if __name__ == '__main__':
    main(sys.argv[1])
