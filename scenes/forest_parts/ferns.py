# SPDX-License-Identifier: GPL-3.0-only
"""Ferns: shuttlecocks of fronds that arch, pinnate once or twice."""

import numpy as np

from model import vectors
from model.meshes import Z, joined, rotated
from model.noise import gradient_noise
from model.portable import PI, Random, cos, power, sin
from model.shapes import tubes

from . import land, leaves
from .branching import UP
from .scatter import scattered

Array = np.ndarray

LEAST_FERN = 20  # triangles
BELTS = [  # least and greatest distance from the eye, ferns, share of the triangles
    (4.5, 16, 28, 0.62), (14, 34, 80, 0.24), (30, 62, 120, 0.14)]


def frond(pairs: int, pinnules: int, length: float, rise: float, random: Random) -> Array:
    """A fern's leaf that springs from the origin and arches towards +x; whole without pairs."""
    if pairs == 0:
        flat = leaves.blade([(0.35, 0.24)], 0.3, 0.5)[..., [0, 2, 1]]
        return length * rotated(flat, Z, 0.6)
    n = 24
    share = (np.arange(n) + 0.5) / n
    elevation = rise - (rise + 0.75) * power(share, 1.5)
    side_bend = 0.35 * float(random.uniform(-1, 1)) * share * share
    step = length / n * np.stack([cos(elevation) * cos(side_bend), sin(elevation),
                                  cos(elevation) * sin(side_bend)], axis=-1)
    rachis = np.concatenate([np.zeros((1, 3)), np.cumsum(step, axis=0)])
    at = 0.16 + 0.83 * (np.arange(pairs) + 0.5) / pairs
    place = at * n
    span = np.minimum(place.astype(np.int64), n - 1)
    base = rachis[span] + (place - span)[:, np.newaxis] * step[span]
    along = vectors.normalized(step)[span]
    aside = vectors.normalized(vectors.cross(along, UP))
    reach = length * 0.27 * np.minimum(1, 0.45 + 3 * (at - 0.16)) * power(1.02 - at, 0.75)
    parts = [tubes(rachis[::6][np.newaxis], 0.03 * (1.1 - np.arange(5) / 4), 3, False)]
    for side in (-1, 1):
        jitter = 0.12 * (random.uniform(0, 1, (pairs, 3)) * 2 - 1)
        direction = vectors.normalized(side * aside + 0.35 * along - 0.15 * UP + jitter)
        upper = vectors.cross(aside, along)
        parts.append(pinnae(base, direction, upper, reach, 1.5 * length / pairs, pinnules))
    return joined(parts)


def pinnae(base: Array, direction: Array, upper: Array, reach: Array, width: float,
           pinnules: int) -> Array:
    """Leaflets of a frond: simple ones, or pinnate once more."""
    if pinnules < 2:
        blade = [leaves.blade([(0.3, 0.25)], 0.25, 0.15)]
        matrices = leaves.frames(direction, upper, reach, np.minimum(reach, 0.75 * width))
        return leaves.strewn(blade, matrices, base)
    at = (np.arange(pinnules) + 0.4) / pinnules
    aside = vectors.normalized(vectors.cross(upper, direction))
    droop = 0.15 * at * at
    place = (base[:, np.newaxis] + reach[:, np.newaxis, np.newaxis] * (
        at[:, np.newaxis] * direction[:, np.newaxis] - droop[:, np.newaxis] * UP)).reshape(-1, 3)
    size = np.tile(0.55 * width * (1.05 - at), len(reach))
    broad = np.repeat(reach, pinnules) / pinnules * 1.1
    blade = [leaves.simple_blade(0.4, 0.5, 0.3)]
    out = np.repeat(direction, pinnules, axis=0)
    meshes = []
    for side in (-1, 1):
        turned = side * np.repeat(aside, pinnules, axis=0) + 0.45 * out
        frame = leaves.frames(turned, np.repeat(upper, pinnules, axis=0), size,
                              np.minimum(broad, size))
        meshes.append(leaves.strewn(blade, frame, place))
    tip = leaves.frames(direction, upper, reach * 0.12, np.minimum(reach * 0.12, 0.06))
    meshes.append(leaves.strewn(blade, tip, base + reach[:, np.newaxis] * 0.97 * direction
                                - 0.15 * reach[:, np.newaxis] * UP))
    return joined(meshes)


def fern(fronds: int, pairs: int, pinnules: int, seed: int) -> Array:
    """A shuttlecock of fronds about the origin."""
    random = Random(300 + seed)
    meshes = []
    for i in range(fronds):
        length = 2.0 + 0.7 * float(random.uniform(-1, 1))
        rise = 1.15 + 0.25 * float(random.uniform(-1, 1))
        turn = 2 * PI * i / fronds + 0.5 * float(random.uniform(-1, 1))
        meshes.append(vectors.transformed(frond(pairs, pinnules, length, rise, random),
                                          vectors.rotation(UP, turn)))
    return joined(meshes)


def ferns(triangles: float) -> Array:
    """In three belts about the eye, the nearest with leaflets of their own."""
    meshes = []
    for belt, (near, far, count, share) in enumerate(BELTS):
        x, z, _, draws = scattered(14 * count, near, far, 420 + belt, 0.9)
        groups = gradient_noise(np.stack([x / 9, 0 * x, z / 9], -1), 423)
        kept = (groups > -0.25 + 0.3 * draws[:, 0]) & (land.beside_path(x, z) > 2.9)
        kept &= ~land.under_log(x, z)
        count = int(min(count, max(1, share * triangles / LEAST_FERN)))
        kept &= np.cumsum(kept) <= count
        each = share * triangles / count
        kinds = [fern(*_leaflets(each, kind), seed=3 * belt + kind) for kind in range(3)]
        size = 0.75 + 0.6 * draws[kept, 1]
        matrices = vectors.rotation(UP, 2 * PI * draws[kept, 2]) * size[:, np.newaxis, np.newaxis]
        meshes.append(leaves.strewn(kinds, matrices, land.on_ground(x[kept], z[kept])))
    return joined(meshes)


def _leaflets(triangles: float, kind: int) -> tuple[int, int, int]:
    """Fronds of a fern of so many triangles, pairs of leaflets of each, pairs of these."""
    fronds = int(min(8 + kind, max(LEAST_FERN / 4, triangles / 72)))
    of_frond = triangles / fronds - 24
    if of_frond < 3 * 8:
        return fronds, 0, 0
    if of_frond < 26 * 8 * 6:
        return fronds, int(min(26, of_frond / 8)), 1
    return fronds, 26, int(min(30, of_frond / (26 * 8)))
