#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""A ball of wiry hair in a photographer's studio: long thin triangles in all directions."""

import numpy as np

from model import vectors
from model.generator import Model, run
from model.meshes import joined, moved
from model.portable import PI, Random, cos, exp, power, sin, smoothstep
from model.shapes import quad, spline, steps, surface, tubes

Array = np.ndarray

RADIUS = 24.0
SEED = 12
LOCKS = 170  # bundles of strands that share their way
STRANDS, SEGMENTS, SIDES = 2150, 115, 3  # of the standard scene
KNOTS, STRIDE = 80, 2.6  # of a lock's way, and their distance
THICKNESS = 0.066  # mean radius of a strand
SPREAD = 1.25  # of the strands of a lock
LOOSE = 0.22  # share of the strands whose ends stand out
SOFT = 2.5  # height of the layer that the floor presses flat
BATCH = 512  # strands at a time

STUDIO_X, STUDIO_Y, BACK, FRONT = 92.0, 92.0, -58.0, 96.0
BEND = 34.0  # radius of the curve from floor to backdrop
SOFTBOX_EXITANCE, RIM_EXITANCE = 18, 8


def build(detail: float) -> Model:
    lights = [(_softbox(), SOFTBOX_EXITANCE), (_rim_light(), RIM_EXITANCE)]
    return Model(joined(_hair(detail), _studio(detail)), lights)


def _hair(detail: float) -> Array:
    count = steps(STRANDS * float(power(detail, 0.68)), 6)
    segments = steps(SEGMENTS * float(power(detail, 0.32)), 8)
    thickness = THICKNESS * np.sqrt(STRANDS / count)
    ways = _ways(Random(SEED), min(count, LOCKS))
    random = Random(SEED + 1)
    meshes = []
    for first in range(0, count, BATCH):
        index = np.arange(first, min(first + BATCH, count))
        paths = _strands(random, ways[index % len(ways)], segments + 1)
        along = np.arange(segments + 1) / segments
        tapered = 0.35 + 0.65 * smoothstep(0, 0.04, along) * smoothstep(1, 0.96, along)
        radius = thickness * _relative_thickness(random, len(index))[:, np.newaxis] * tapered
        meshes.append(tubes(paths, radius, SIDES))
    return joined(meshes)


def _relative_thickness(random: Random, count: int) -> Array:
    """Mostly fine hair, and a few bristles."""
    rank = random.uniform(0, 1, count)
    squared = rank * rank
    return 0.65 + 1.7 * squared * squared * squared


def _ways(random: Random, count: int) -> Array:
    """Knots (count, KNOTS, 3) of walks around the ball's centre, along great circles whose planes
    turn slowly, at a depth that changes slowly."""
    start = random.direction(LOCKS)[:count]
    drift = random.uniform(-1, 1, (LOCKS, 9, 3))[:count]
    depth = random.uniform(0, 1, (LOCKS, 14))[:count]
    depth = np.clip(spline(depth[..., np.newaxis], KNOTS)[..., 0], 0, 1)
    radius = RADIUS * (0.42 + 0.56 * np.sqrt(depth))
    turns = spline(drift, KNOTS)
    axis = vectors.perpendicular(start)
    direction, ways = start, []
    for i in range(KNOTS):
        ways.append(direction * radius[:, i, np.newaxis])
        axis = vectors.normalized(axis + 0.16 * turns[:, i])
        axis = axis - direction * vectors.dot(axis, direction)[:, np.newaxis]
        axis = vectors.normalized(axis)
        rotation = vectors.rotation(axis, STRIDE / radius[:, i])
        direction = vectors.normalized(vectors.transformed(direction, rotation))
    return np.stack(ways, axis=1)


def _strands(random: Random, ways: Array, samples: int) -> Array:
    """Strands near the ways of their locks, resting on the floor."""
    count = len(ways)
    offset = random.uniform(-1, 1, (count, 1, 3)) + 0.55 * random.uniform(-1, 1, (count, 17, 3))
    slip = random.uniform(0, 1, (count, 4))
    along = np.arange(samples) / (samples - 1)
    tightness = 0.62 + 0.38 * cos(along * 12 + 2 * PI * slip[:, :1])
    paths = spline(ways, samples) + SPREAD * tightness[..., np.newaxis] * spline(offset, samples)
    free = smoothstep(0.87, 1.0, along) * (slip[:, 1:2] < LOOSE)
    out = free * (0.1 + 0.35 * slip[:, 2:3])
    paths = paths * (1 + out[..., np.newaxis])
    paths = moved(paths, y=RADIUS - 0.6)
    height = paths[..., 1] - THICKNESS * 2
    pressed = SOFT * exp(np.minimum(height / SOFT, 1) - 1)
    paths[..., 1] = np.where(height < SOFT, pressed, height) + THICKNESS * 2
    return paths


def _softbox() -> Array:
    return quad((-58, 66, 52), (-50, 84, 2), (6, 84, 2), (-2, 66, 52))


def _rim_light() -> Array:
    return quad((64, 14, -34), (74, 14, -4), (74, 62, -4), (64, 62, -34))


def _studio(detail: float) -> list[Array]:
    """A room whose floor runs up into its back wall in a curve."""
    w, h = STUDIO_X, STUDIO_Y
    turn = np.arange(steps(48 * np.sqrt(detail), 4) + 1)
    turn = turn * (PI / 2 / turn[-1])
    z = np.concatenate([[FRONT], BACK + BEND * (1 - sin(turn)), [BACK]])
    y = np.concatenate([[0], BEND * (1 - cos(turn)), [h]])
    rim = [np.stack([np.full_like(z, x), y, z], axis=-1) for x in (-w, w)]
    sides = [quad((x, 0, FRONT), (x, 0, BACK), (x, h, BACK), (x, h, FRONT)) for x in (-w, w)]
    return [surface(np.stack(rim)), *sides,
            quad((-w, 0, FRONT), (w, 0, FRONT), (w, h, FRONT), (-w, h, FRONT)),
            quad((-w, h, BACK), (w, h, BACK), (w, h, FRONT), (-w, h, FRONT))]


if __name__ == '__main__':
    run(__doc__, build)
