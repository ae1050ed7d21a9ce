# SPDX-License-Identifier: GPL-3.0-only
"""What people work with at the table. All lie on the origin; the user looks towards +z."""

import numpy as np

from model.meshes import X, Y, Z, joined, moved, rotated
from model.portable import PI, Random, sin
from model.shapes import cylinder, quad, rounded_box, steps, surface

from .basics import COARSE, bar, boxes, edge_dense

Array = np.ndarray
LAPTOP = 3.3, 2.3, 0.13  # width, depth, thickness
KEYS = 14, 5
A4 = 2.1, 2.97


def keyboard() -> Array:
    """Rows of keys with a space bar in the nearest."""
    columns, rows = KEYS
    pitch, size = 0.212, 0.18
    low = [(-(columns / 2 - i) * pitch, LAPTOP[2] - 0.01, 0.92 + j * pitch)
           for j in range(rows) for i in range(columns) if j > 0 or not 4 <= i < 9]
    low = np.array(low)
    high = low + [size, 0.045, size]
    space = [(-(columns / 2 - 4) * pitch, LAPTOP[2] - 0.01, 0.92)]
    return boxes(np.concatenate([low, space]),
                 np.concatenate([high, np.array(space) + [5 * pitch - 0.03, 0.045, size]]),
                 ('bottom',))


def laptop(opening: float, fine: float) -> Array:
    """Open by that angle."""
    width, depth, thickness = LAPTOP
    if fine < COARSE:
        lid = quad((-width / 2, 0, 0), (width / 2, 0, 0), (width / 2, depth, 0),
                   (-width / 2, depth, 0))
        base = boxes((-width / 2, 0, 0), (width / 2, thickness, depth),
                     ('bottom', 'back', 'left', 'right', 'front'))
        return joined(base, moved(rotated(lid, X, opening - PI / 2), 0, thickness, depth))
    if fine < 0.2:
        lid = boxes((-width / 2, 0, 0), (width / 2, depth, 0.07), ('bottom', 'back'))
        base = boxes((-width / 2, 0.01, 0), (width / 2, thickness, depth), ('bottom',))
        return joined(base, moved(rotated(lid, X, opening - PI / 2), 0, thickness, depth))
    base = rounded_box((-width / 2, 0.01, 0), (width / 2, thickness, depth), 0.05,
                       steps(4 * fine, 1))
    lid = joined(rounded_box((-width / 2, 0, 0), (width / 2, depth, 0.08), 0.035,
                             steps(4 * fine, 1)), bezel(width, depth))
    end = np.array([width / 2 - 0.3, thickness, depth])
    hinge = bar(np.stack([end * [-1, 1, 1], end]), 0.055, steps(12 * fine, 4))
    pad = boxes((-0.5, thickness - 0.01, 0.12), (0.5, thickness + 0.008, 0.8), ('bottom',))
    return joined(base, keyboard(), pad, hinge,
                  moved(rotated(lid, X, opening - PI / 2), 0, thickness + 0.04, depth))


def bezel(width: float, depth: float) -> Array:
    """Around the screen, on the side of the lid that faces the user."""
    a, low, high, edge = width / 2 - 0.04, 0.08, depth - 0.05, 0.12
    level = boxes([(-a, low, -0.02), (-a, high - edge, -0.02)],
                  [(a, low + 2 * edge, 0.01), (a, high, 0.01)], ('front',))
    upright = boxes([(-a, low + 2 * edge, -0.02), (a - edge, low + 2 * edge, -0.02)],
                    [(-a + edge, high - edge, 0.01), (a, high - edge, 0.01)],
                    ('front', 'bottom', 'top'))
    return joined(level, upright)


def sheet(curl: float, fine: float) -> Array:
    """A page whose far corner lifts."""
    count = steps(9 * fine, 1)
    x, z = np.meshgrid(edge_dense(count) / 2, edge_dense(count) / 2, indexing='ij')
    lift = np.maximum(0, x + z - 0.25)
    y = curl * lift * lift + 0.01 * curl * sin(5 * x + 3 * z)
    return surface(np.stack([A4[0] * x, y + 0.01 * curl, A4[1] * z], axis=-1)[::-1])


def papers(sheets: int, fan: float, fine: float, seed: int) -> Array:
    """A stack of paper under a few loose sheets."""
    random = Random(seed)
    height = 0.16
    parts = [boxes((-A4[0] / 2, 0.005, -A4[1] / 2), (A4[0] / 2, height, A4[1] / 2), ('bottom',))]
    for i in range(sheets if fine > COARSE else 0):
        page = sheet(float(random.uniform(0.05, 0.45)), fine)
        angle = fan * (i + 1) + float(random.uniform(-0.06, 0.06))
        x, z = random.uniform(-0.12, 0.12, 2)
        parts.append(moved(rotated(page, Y, angle), x, height + 0.012 + 0.016 * i, z))
    return joined(parts)


def notebook(fine: float) -> Array:
    """A5, with covers, and wire rings along its left edge."""
    covers = boxes([(-0.74, 0.005, -1.05), (-0.74, 0.2, -1.05)],
                   [(0.74, 0.03, 1.05), (0.74, 0.225, 1.05)])
    pages = boxes((-0.66, 0.03, -1.02), (0.71, 0.2, 1.02), ('bottom', 'top'))
    if fine < 0.3:
        return joined(covers, pages)
    count = steps(12 * fine, 5)
    angle = np.arange(count) * (2 * PI / (count - 1))
    ring = np.stack([-0.7 + 0.15 * sin(angle), 0.14 + 0.14 * sin(angle, 1), 0 * angle], axis=-1)
    wire = bar(ring, 0.014, steps(5 * fine, 3))
    return joined(covers, pages, [moved(wire, 0, 0, -0.95 + 0.11 * i) for i in range(18)])


def pen(fine: float) -> Array:
    """Along z, with a clip."""
    z = np.array([-0.7, -0.6, -0.58, 0.1, 0.12, 0.62, 0.64, 0.72])
    radius = np.array([0.012, 0.03, 0.045, 0.05, 0.056, 0.052, 0.03, 0.026])
    path = np.stack([0 * z, np.full(8, 0.056), z], axis=-1)
    clip = boxes((-0.015, 0.1, 0.2), (0.015, 0.125, 0.6))
    return joined(bar(path, radius, steps(10 * fine, 3)), clip if fine > 0.3 else [])


def folder(fine: float) -> Array:
    """A clasp folder, closed around a few pages."""
    covers = boxes([(-1.2, 0.005, -1.6), (-1.2, 0.21, -1.6)], [(1.2, 0.03, 1.6), (1.2, 0.24, 1.6)])
    spine = boxes((-1.22, 0.01, -1.59), (-1.19, 0.235, 1.59))
    pages = boxes((-1.15, 0.03, -1.5), (1.05, 0.21, 1.48), ('bottom', 'top'))
    band = boxes((0.75, 0.003, -1.61), (0.85, 0.25, 1.61))
    return joined(covers, spine, pages, band if fine > 0.2 else [])


def phone(fine: float) -> Array:
    """A conference phone: a three-armed star with a keypad."""
    segments = steps(96 * fine, 9)
    rings = [(1.0, 0.02), (1.04, 0.12), (1.0, 0.22), (0.8, 0.36), (0.5, 0.44), (0.0, 0.46)]
    angle = np.arange(segments) * (-2 * PI / segments)
    star = 0.95 + 0.35 * sin(3 * angle, 1)
    points = [np.stack([r * star * sin(angle, 1), np.full(segments, y), r * star * sin(angle)],
                       axis=-1) for r, y in rings]
    keys = np.array([((i - 1) * 0.2 - 0.07, 0.42, -0.4 - 0.17 * j) for i in range(3)
                     for j in range(4)])
    buttons = boxes(keys, keys + [0.14, 0.07, 0.11], ('bottom',))
    display = rotated(boxes((-0.35, 0.4, -0.16), (0.35, 0.52, 0.22), ('bottom',)), X, 0.1)
    return joined(surface(np.stack(points, axis=1), closed_u=True), buttons, display)


def remote_control(fine: float) -> Array:
    body = rounded_box((-0.24, 0.01, -0.85), (0.24, 0.2, 0.85), 0.08, steps(4 * fine, 1))
    low = np.array([(-0.15 + 0.12 * i, 0.18, -0.6 + 0.17 * j) for i in range(3) for j in range(7)])
    return joined(body, boxes(low, low + [0.07, 0.05, 0.1], ('bottom',)))


def marker(fine: float) -> Array:
    """A thick pen, along x."""
    body = rotated(cylinder(0.1, -0.6, 0.45, steps(12 * fine, 4)), Z, -PI / 2)
    cap = rotated(cylinder(0.115, 0.25, 0.62, steps(12 * fine, 4)), Z, -PI / 2)
    return moved(joined(body, cap), 0, 0.12, 0)
