# SPDX-License-Identifier: GPL-3.0-only
"""Shell seats, row by row."""

import numpy as np

from model.meshes import joined, repeated
from model.portable import Random
from model.shapes import spline, steps, surface

from . import plan
from .stands import ENTRANCE, STAIR_WIDTH, Tier

Array = np.ndarray

WIDTH, PITCH = 0.41, 0.49
# Depth (towards the pitch) and height of the shell, from its front lip over pan and back to the
# top's lip, as seen from the middle of the back edge of the pan.
SECTION = [(0.36, 0.27), (0.34, 0.32), (0.06, 0.28), (-0.01, 0.36), (-0.07, 0.68), (-0.1, 0.66)]
HOLLOW = 0.035  # how much deeper the shell's middle is than its sides
LIP = 0.03  # width of the rim that is bent back
BEHIND = 0.16  # from the pan's back edge to the next step
LEG = 0.06  # half the width of the leg


def across(segments: int) -> list[tuple[float, float]]:
    """Place and depth of the points between the seat's sides."""
    if segments < 3:
        return [(-WIDTH / 2, 0.0), (WIDTH / 2, 0.0)]
    place = np.arange(segments - 1) / (segments - 2) * 2 - 1
    inner = [(p * (WIDTH / 2 - 0.01), (1 - p * p) * HOLLOW) for p in place.tolist()]
    return [(-WIDTH / 2, LIP), *inner, (WIDTH / 2, LIP)]


def along(segments: int) -> Array:
    """Points of the section, and the direction into which it is hollow."""
    if segments < len(SECTION):
        points = np.array([SECTION[1], SECTION[2], SECTION[4]])
    elif segments == len(SECTION):
        points = np.array(SECTION)
    else:
        points = spline(np.array(SECTION), segments)
    tangent = points[np.minimum(np.arange(len(points)) + 1, len(points) - 1)] - (
        points[np.maximum(np.arange(len(points)) - 1, 0)])
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
    size = np.sqrt(normal[:, :1] * normal[:, :1] + normal[:, 1:] * normal[:, 1:])
    return np.stack([points, -normal / size], axis=1)


def seat(across_segments: int, along_points: int) -> Array:
    """Facing z, with its leg on the floor; the next step is behind the origin."""
    grid = []
    for x, depth in across(across_segments):
        points = along(along_points)
        section = points[:, 0] + depth * points[:, 1]
        grid.append(np.stack([np.full(len(section), x), section[:, 1], section[:, 0] + BEHIND], -1))
    foot = np.array([(-LEG, BEHIND), (0, BEHIND + 0.12), (LEG, BEHIND)])
    leg = np.stack([np.stack([foot[:, 0], np.full(3, h), foot[:, 1]], axis=-1)
                    for h in (-0.02, 0.29)], axis=1)
    return joined(surface(np.array(grid)), surface(leg, closed_u=True))


def places(tier: Tier, row: int, pitch: float) -> Array:
    """Directions of the seats of a row: between the stairs, but not where an entrance is."""
    offset = tier.row_offset(row + 1) - BEHIND
    starts = plan.length_to(plan.bays([0, *ENTRANCE, 0.9999999]), offset)
    first, last = tier.entrance_rows()
    runs = []
    for bay, (start, left, right, end) in enumerate(starts.tolist()):
        start, end = start + STAIR_WIDTH / 2, end - STAIR_WIDTH / 2
        if bay in tier.entrance_bays and first <= row <= last:
            runs += [(start, left - 0.2), (right + 0.2, end)]
        else:
            runs.append((start, end))
    lengths = []
    for start, end in runs:
        count = max(0, int((end - start) / pitch))
        lengths.append((start + end) / 2 + (np.arange(count) - (count - 1) / 2) * pitch)
    return plan.angle_at(np.concatenate(lengths), offset)


def shape(detail: float) -> tuple[int, int]:
    """Segments across, points along."""
    if detail < 0.4:
        return 1, 3
    across_segments = steps(3 * detail**0.5, 3)
    return across_segments, max(len(SECTION), steps(15 * detail / across_segments, 5) + 1)


def coarseness(detail: float) -> float:
    """How many times as wide and far apart seats are as they should be, so that there are few
    enough of them."""
    ratio = len(seat(*shape(detail))) / (len(seat(*shape(1))) * detail)
    return max(1.0, ratio)**0.5


def seats(tier: Tier, detail: float, random: Random) -> Array:
    """All seats of a tier, each turned by a hair."""
    width = coarseness(detail)
    angles = [places(tier, row, PITCH * width) for row in range(tier.rows)]
    row = np.repeat(np.arange(tier.rows), [len(a) for a in angles])
    angle = np.concatenate(angles)
    offsets = plan.at(angle, tier.row_height(row), tier.row_offset(row + 1))
    turn = random.uniform(-0.06, 0.06, len(angle))
    mesh = seat(*shape(detail)) * np.array([width, 1.0, 1.0])
    return repeated(mesh, plan.facing_in(angle + turn), offsets)
