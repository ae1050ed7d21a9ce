# SPDX-License-Identifier: GPL-3.0-only
"""Picks triangles of the box in the viewer, and makes lights of them."""

import re
from pathlib import Path

import numpy as np

from box import box_triangles
from viewer import HEIGHT, WIDTH, Viewer

POSITION, DEPTH, FILM_HEIGHT = np.array([0, 0, 0.9]), 1, 1.5


def seen_at(x: int, y: int, width: int = WIDTH, height: int = HEIGHT) -> tuple[int, float]:
    """Triangle and distance at the centre of a pixel, as the camera of the box sees it."""
    direction = np.array([FILM_HEIGHT * width / height * ((x + 0.5) / width - 0.5),
                          FILM_HEIGHT * (0.5 - (y + 0.5) / height), -DEPTH])
    direction /= np.linalg.norm(direction)
    a, b, c = box_triangles().transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    with np.errstate(divide='ignore', invalid='ignore'):
        distance = ((a - POSITION) * normal).sum(axis=1) / (normal @ direction)
        point = POSITION + distance[:, None] * direction
    is_inside = distance > 0
    for corner, following in [(a, b), (b, c), (c, a)]:
        is_inside &= (np.cross(following - corner, point - corner) * normal).sum(axis=1) > 0
    triangle = np.where(is_inside, distance, np.inf).argmin()
    return int(triangle), float(distance[triangle])


def lights_of(text: str) -> list[tuple[int, int, float]]:
    """The last lights that a text has: first and last triangle, and exitance."""
    count, *numbers = text[text.rindex('lights ') + len('lights '):].split()
    entries = [numbers[3 * i:3 * i + 3] for i in range(int(count))]
    return [(int(first), int(last), float(exitance)) for first, last, exitance in entries]


def lights_after(viewer: Viewer, *words: object) -> list[tuple[int, int, float]]:
    """The lights that the viewer prints after this command of xdotool."""
    return lights_of(viewer.answer(r'^lights \d+\n?(.*\d\n)*', *words)[0])


def lights_after_click(viewer: Viewer, x: int, y: int) -> list[tuple[int, int, float]]:
    return lights_after(viewer, 'mousemove', x, y, 'click', 1)


def saved(viewer: Viewer) -> tuple[str, str]:
    """Names of the scene and of the copy of the old one."""
    match = viewer.answer(r'^scene (.*) backup (.*)\n', 'key', 'ctrl+s')
    return Path(match[1]).name, Path(match[2]).name


def picked(viewer: Viewer, x: int, y: int, button: int = 1) -> re.Match:
    return viewer.answer(
        r'^triangle (\d+) distance (\S+) point (\S+) (\S+) (\S+) normal (\S+) (\S+) (\S+) '
        r'area (\S+)\n', 'mousemove', x, y, 'click', button)
