# SPDX-License-Identifier: GPL-3.0-only
"""An eagle owl on a rock, as a function that is negative inside.

Points are arrays (3, n). The owl looks along z and is symmetric in x but for its turned head; its
feet stand at the height 0. Most lengths are in units of 100 mm.
"""

import numpy as np

from model import vectors
from model.implicit import (ellipsoid, limb, polygonised, round_cone, rounded_block, smooth_max,
                            smooth_min, united)
from model.noise import fractal_noise, gradient_noise
from model.portable import PI, angle, cos, sin, smoothstep

Array = np.ndarray

LOW, HIGH = (-4.4, -2.9, -4.6), (4.4, 12.8, 4.2)  # a box around the owl and its rock
ROCK_BOTTOM = -2.4
STEEPNESS = 2.2  # of the relief
RELIEF = 0.5  # the relief of a part does not matter farther from its surface than this

HEAD = np.array([0, 9.15, 0.45])
HEAD_TURN = -0.32  # radians, towards x
EYE = (0.98, 0.05, 1.42)  # in the frame of the head, as all of the face
EYE_RADIUS = 0.66

WING = np.array([2.2, 3.95, -0.7])
WING_HALF = np.array([4.6, 0.6, 2.05])  # along, outwards, across
ALONG = vectors.normalized(np.array([-0.14, -0.945, -0.33]))  # from the shoulder to the tip
ACROSS = vectors.normalized(vectors.cross(ALONG, np.array([1, 0, -0.12])))
OUTWARDS = vectors.cross(ACROSS, ALONG)


def owl(spacing: float) -> Array:
    return polygonised(statue, LOW, HIGH, spacing, STEEPNESS)


def statue(p: Array) -> Array:
    mirrored = np.stack([np.abs(p[0]), p[1], p[2]])
    bird = smooth_min(_body(p, mirrored), _wing(mirrored), 0.12)
    bird = smooth_min(bird, _head(p), 0.35)
    bird = smooth_min(bird, _foot(mirrored), 0.1)
    return smooth_min(bird, _rock(p), 0.06)


def _raised(distance: Array, points: Array, relief) -> Array:
    """The distance minus the height of a relief, which is evaluated near the surface alone."""
    near = np.flatnonzero(np.abs(distance) < RELIEF)
    raised = distance.copy()
    if len(near):
        raised[near] -= relief(points[:, near])
    return raised


def _mixed(a: Array, b: Array, share: Array) -> Array:
    return a + share * (b - a)


def _noise(p: Array, frequency: float, seed: int) -> Array:
    return gradient_noise(p.T * frequency, seed)


def _plumage(across: Array, rows: Array, along: Array, barbs: float) -> Array:
    """Height, 0 to about 1, of feathers that overlap like tiles: one unit of `across` is the width
    of a feather, one of `rows` the distance of two rows, which run towards the feathers' tips."""
    height = np.zeros_like(across)
    for before in range(2):
        row = np.floor(rows) - before
        w = rows - row  # from the feather's root, 0 to 2
        column = across + 0.5 * (row - 2 * np.floor(row / 2))
        u = np.abs(column - np.floor(column) - 0.5)
        taper = np.maximum(w - 0.55, 0) / 1.1
        inside = smoothstep(0, 0.22, 1 - (u / 0.56)**2 - taper * taper)
        shaft = 0.16 * np.maximum(1 - u / 0.09, 0)
        phase = along * barbs - u * 3
        barb = 0.13 * np.abs(2 * (phase - np.floor(phase)) - 1)
        arch = 0.25 * (1 - 3 * u * u)
        height = np.maximum(height, inside * (0.1 + 0.42 * w + arch + shaft + barb) * 0.8)
    return height


def _body(p: Array, mirrored: Array) -> Array:
    chest = ellipsoid(p, (0, 5.8, 0.4), (2.65, 2.6, 2.2))
    belly = ellipsoid(p, (0, 3.6, 0.0), (2.2, 2.9, 1.9))
    back = ellipsoid(p, (0, 5.0, -1.0), (2.1, 3.6, 1.5))
    thigh = round_cone(mirrored, (1.15, 2.6, 0.75), (1.2, 0.75, 1.05), 1.15, 0.62)
    tail = rounded_block(_tilted(p), (0, 0, 0), (1.35, 2.6, 0.28), 0.25)
    trunk = united([chest, belly, back], 1.2)
    trunk = smooth_min(smooth_min(trunk, thigh, 0.7), tail, 0.5)
    return _raised(trunk, p, _body_feathers)


def _tilted(p: Array) -> Array:
    """In the frame of the tail, which hangs down and backwards."""
    c, s = 0.94, 0.342
    y, z = p[1] - 0.6, p[2] + 2.0
    return np.stack([p[0], c * y + s * z, c * z - s * y])


def _body_feathers(p: Array) -> Array:
    wander = _noise(p, 0.45, 11)
    rows = -p[1] / 0.56 + 0.55 * wander + 0.5 * _noise(p, 0.9, 12)
    across = angle(p[2] + 0.4, p[0]) * (24 / (2 * PI)) + 0.3 * _noise(p, 0.7, 13)
    feathers = _plumage(across, rows, -p[1] + 0.3 * wander, 3.8)
    return 0.19 * feathers + 0.05 * _noise(p, 1.6, 14)


def _wing(p: Array) -> Array:
    q = p - WING[:, np.newaxis]
    s, t, w = (q[0] * axis[0] + q[1] * axis[1] + q[2] * axis[2]
               for axis in (ALONG, OUTWARDS, ACROSS))
    bent = t + 0.13 * w * w + 0.012 * s * s
    slim = 1 - 0.075 * (s + 1)  # narrower towards the tip
    frame = np.stack([s, bent, w / slim])
    wing = ellipsoid(frame, (0, 0, 0), WING_HALF) * 0.85
    return _raised(wing, np.stack([s, t, w / slim]), _wing_feathers)


def _wing_feathers(frame: Array) -> Array:
    """Rows of coverts, which grow into the flight feathers towards the tip."""
    along, across = frame[0], frame[2]
    wander = _noise(frame, 0.5, 21)
    t = np.clip((along + WING_HALF[0]) / (2 * WING_HALF[0]), 0, 1)
    rows = 11 * t * (1.75 - 0.85 * t) + 0.3 * wander - 0.12 * across * across
    feathers = _plumage(across / 0.62 + 0.2 * wander, rows, along, 3.4)
    return (0.18 + 0.08 * t) * feathers


def _head(p: Array) -> Array:
    q = p - HEAD[:, np.newaxis]
    c, s = float(cos(HEAD_TURN)), float(sin(HEAD_TURN))
    q = np.stack([c * q[0] - s * q[2], q[1], s * q[0] + c * q[2]])
    m = np.stack([np.abs(q[0]), q[1], q[2]])
    skull = ellipsoid(q, (0, 0, 0), (2.25, 1.9, 1.9))
    cheek = ellipsoid(m, (1.0, -0.15, 0.85), (1.5, 1.5, 1.05))
    crown = smooth_min(skull, cheek, 0.5)
    crown = smooth_min(crown, ellipsoid(q, (0, -1.7, 0), (2.0, 1.2, 1.7)), 0.8)
    crown = _raised(crown, q, _head_relief)
    brow = limb(m, [(0.12, 0.1, 1.98), (0.8, 0.85, 1.72), (1.6, 1.45, 0.95), (1.98, 2.3, 0.35),
                    (2.08, 3.2, 0.0)], [0.18, 0.26, 0.5, 0.34, 0.03], 0.3)
    brow = _raised(brow, m, _tuft_feathers)
    crown = smooth_min(crown, brow, 0.22)
    return smooth_min(_with_eye(crown, m), _beak(q), 0.07)


def _head_relief(q: Array) -> Array:
    """Feathers that stream backwards, and the dished discs around the eyes with their rays."""
    x, y = np.abs(q[0]) - EYE[0], q[1] - EYE[1]
    r = np.sqrt(x * x + y * y * 0.85)
    front = smoothstep(0.35, 0.9, q[2])
    wander = _noise(q, 0.8, 31)
    rows = -q[2] / 0.42 + 0.6 * wander
    across = angle(q[1] + 0.2, q[0]) * (22 / (2 * PI)) + 0.3 * wander
    plumage = 0.12 * _plumage(across, rows, -q[2], 4.5)
    turn = angle(x, y) * (23 / PI) + 0.5 * wander
    ray = np.abs(2 * (turn - np.floor(turn)) - 1)
    tier = r * 2.9 + 0.3 * ray
    step = np.abs(2 * (tier - np.floor(tier)) - 1)
    rays = (0.045 * ray + 0.05 * step) * smoothstep(0.7, 0.95, r)
    dish = -0.24 * (1 - smoothstep(0.75, 1.4, r)) + rays
    rim = 0.13 * smoothstep(0.2, 0, np.abs(r - 1.5))
    disc = front * (1 - smoothstep(1.35, 1.55, r))
    return _mixed(plumage, dish, disc) + front * rim


def _tuft_feathers(m: Array) -> Array:
    """Strands along the brow and up the ear tuft."""
    x, y, z = m[0] - 1.7, m[1] - 1.7, m[2] - 0.8
    strand = _mixed(0.56 * y - 0.75 * x - 0.34 * z, -0.67 * x - 0.2 * y - 0.71 * z,
                    smoothstep(-0.3, 0.5, y))
    strand = strand * 4.5 + 0.6 * _noise(m, 1.3, 33)
    fine = 1 - 0.75 * smoothstep(1.8, 3.0, m[1])
    return fine * 0.09 * np.abs(2 * (strand - np.floor(strand)) - 1)


def _with_eye(head: Array, m: Array) -> Array:
    ball = _ball(m, EYE, EYE_RADIUS)
    x, y = m[0] - EYE[0] - 0.02, m[1] - EYE[1]
    r = np.sqrt(x * x + y * y)
    pupil = np.maximum(r - 0.26, EYE[2] + 0.05 - m[2])
    iris = 0.035 * smoothstep(0.05, 0.0, np.abs(r - 0.46))
    eye = smooth_max(ball + iris, -pupil, 0.05)
    ring = np.sqrt((r - 0.67)**2 + (m[2] - EYE[2] - 0.14)**2) - 0.1
    return smooth_min(smooth_min(head, ring, 0.1), eye, 0.03)


def _ball(p: Array, center: Array, radius: float) -> Array:
    x, y, z = (p[i] - center[i] for i in range(3))
    return np.sqrt(x * x + y * y + z * z) - radius


def _beak(q: Array) -> Array:
    return limb(q, [(0, 0.25, 1.7), (0, -0.2, 2.18), (0, -0.62, 2.4), (0, -1.0, 2.4),
                    (0, -1.38, 2.22)], [0.14, 0.23, 0.21, 0.12, 0.02], 0.12)


def _foot(p: Array) -> Array:
    toes = []
    for x, z in ((-0.62, 2.15), (0.02, 2.45), (0.66, 2.2)):
        x0, x1 = 1.2 + 0.4 * x, 1.2 + x
        toe = limb(p, [(x0, 0.4, 1.3), ((x0 + x1) / 2, 0.42, 0.55 + z / 2), (x1, 0.1, z)],
                   [0.3, 0.27, 0.24], 0.1)
        talon = limb(p, [(x1, 0.16, z), (x1 + 0.02, 0.02, z + 0.32), (x1, -0.45, z + 0.42)],
                     [0.17, 0.13, 0.03], 0.05)
        toes.append(smooth_min(toe, talon, 0.03))
    return _raised(united(toes, 0.08), p, _scutes)


def _scutes(p: Array) -> Array:
    phase = (p[2] + 0.6 * p[1]) * 5.5
    return 0.025 * np.abs(2 * (phase - np.floor(phase)) - 1)


def _rock(p: Array) -> Array:
    block = rounded_block(p, (0, ROCK_BOTTOM / 2 - 0.15, 0.0), (3.0, 1.05, 2.5), 0.5)
    return _raised(block, p, _hewn)


def _hewn(p: Array) -> Array:
    rough = fractal_noise(p.T * 0.9, 2, 41)
    chisel = (p[0] * 0.5 + p[1] * 0.8 + p[2] * 0.35) * 2.2 + 1.2 * _noise(p, 0.8, 43)
    groove = np.abs(2 * (chisel - np.floor(chisel)) - 1)
    return 0.3 * rough + 0.06 * groove + 0.02 * _noise(p, 5, 44)
