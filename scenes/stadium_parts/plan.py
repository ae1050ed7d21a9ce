# SPDX-License-Identifier: GPL-3.0-only
"""The oval on which all rings of the stadium are drawn.

It consists of arcs that meet with a common tangent: flat ones along the two ends (at x) and the two
sides (at z) of the pitch, and tight ones at the corners. A place is given by the direction of the
outward normal, an angle from x towards z, and by the distance outwards from the edge of the arena.
All rings have the same normals, so stairs and rafters are straight.
"""

import numpy as np

from model import vectors
from model.portable import PI, cos, sin
from model.shapes import box, halves

Array = np.ndarray

ARENA = 50.5  # from the middle to the edge at the ends
END_RADIUS, CORNER_RADIUS = 90.0, 13.0
END_ANGLE, SIDE_ANGLE = 13 * PI / 180, 80 * PI / 180  # the corner's arc lies between
BAYS = 48  # between two stairs; a multiple of four
BAYS_EVEN_AT = 16.0  # outwards, where all bays have the same length

_END = np.array([ARENA - END_RADIUS, 0.0])
_CORNER = _END + (END_RADIUS - CORNER_RADIUS) * np.array([cos(END_ANGLE), sin(END_ANGLE)])
SIDE_RADIUS = CORNER_RADIUS + float(_CORNER[0] / cos(SIDE_ANGLE))
_SIDE = np.array([0.0, _CORNER[1] - (SIDE_RADIUS - CORNER_RADIUS) * sin(SIDE_ANGLE)])
_CENTRES = np.array([_END, _CORNER, _SIDE])
_RADII = np.array([END_RADIUS, CORNER_RADIUS, SIDE_RADIUS])
_BREAKS = np.array([0, END_ANGLE, SIDE_ANGLE, PI - SIDE_ANGLE, PI - END_ANGLE, PI + END_ANGLE,
                    PI + SIDE_ANGLE, 2 * PI - SIDE_ANGLE, 2 * PI - END_ANGLE, 2 * PI])
_BREAK_RADII = _RADII[[0, 1, 2, 1, 0, 1, 2, 1, 0]]


def at(angle: Array | float, height: Array | float, offset: Array | float) -> Array:
    """Points (..., 3)."""
    c, s = cos(angle), sin(angle)
    arc = ((np.abs(s) * cos(END_ANGLE) > np.abs(c) * sin(END_ANGLE)).astype(np.int64)
           + (np.abs(s) * cos(SIDE_ANGLE) > np.abs(c) * sin(SIDE_ANGLE)))
    x = np.sign(c) * _CENTRES[arc, 0] + (_RADII[arc] + offset) * c
    z = np.sign(s) * _CENTRES[arc, 1] + (_RADII[arc] + offset) * s
    return np.stack(np.broadcast_arrays(x, height, z), axis=-1)


def _lengths(offset: float) -> Array:
    """From the first break to each."""
    return np.concatenate([[0.0], np.cumsum((_BREAK_RADII + offset) * np.diff(_BREAKS))])


def _arc(values: Array, breaks: Array) -> Array:
    """Between which of the breaks each value lies."""
    return np.clip(np.searchsorted(breaks, values, side='right') - 1, 0, len(_BREAK_RADII) - 1)


def length_to(angle: Array, offset: float) -> Array:
    """Along a ring, from the direction of x."""
    arc = _arc(angle, _BREAKS)
    return _lengths(offset)[arc] + (_BREAK_RADII[arc] + offset) * (angle - _BREAKS[arc])


def angle_at(length: Array, offset: float) -> Array:
    """The inverse of length_to."""
    lengths = _lengths(offset)
    arc = _arc(length, lengths)
    return _BREAKS[arc] + (length - lengths[arc]) / (_BREAK_RADII[arc] + offset)


def evenly(count: int, offset: float = BAYS_EVEN_AT, start: float = 0) -> Array:
    """Directions of places at equal distances along a ring, the first one after `start` steps."""
    return angle_at((np.arange(count) + start) * (perimeter(offset) / count), offset)


def perimeter(offset: float) -> float:
    return float(_lengths(offset)[-1])


def bays(fractions: list[float]) -> Array:
    """Directions (bays, n) at fractions of each bay."""
    place = np.arange(BAYS)[:, np.newaxis] + np.array(fractions, dtype=float)
    return angle_at(place * (perimeter(BAYS_EVEN_AT) / BAYS), BAYS_EVEN_AT)


def radius(angle: Array, offset: float) -> Array:
    """Of the curvature of a ring."""
    return _BREAK_RADII[_arc(angle, _BREAKS)] + offset


def facing_in(angle: Array) -> Array:
    """Matrices that turn x to the left as seen from the pitch, and z towards the pitch."""
    c, s, zero = cos(angle), sin(angle), np.zeros_like(angle)
    return vectors.frame(np.stack([-s, zero, c], axis=-1), np.array([0.0, 1.0, 0.0]),
                         np.stack([-c, zero, -s], axis=-1))


def bent(mesh: Array) -> Array:
    """A mesh with coordinates (angle, height, offset), brought to its place."""
    return at(mesh[..., 0], mesh[..., 1], mesh[..., 2])


def bent_boxes(angles: Array, width: float, heights: tuple[float, float],
               offsets: tuple[float, float]) -> Array:
    """Boxes that follow the rings, with their middles in these directions."""
    half = 0.5 * width / radius(angles, offsets[0])
    unit = box((-1, heights[0], offsets[0]), (1, heights[1], offsets[1]))
    boxes = np.repeat(unit[np.newaxis], len(angles), axis=0)
    boxes[..., 0] = boxes[..., 0] * half[:, np.newaxis, np.newaxis] + (
        angles[:, np.newaxis, np.newaxis])
    return bent(boxes).reshape(-1, 3, 3)


def ring(profile: Array, angles: Array) -> Array:
    """A profile (n, 2) of offset and height, drawn around the whole oval; (angles, n - 1, 2, 3, 3)
    triangles: two for each cell."""
    profile = np.asarray(profile, dtype=float)
    points = at(angles[:, np.newaxis], profile[:, 1], profile[:, 0])
    following = np.roll(points, -1, axis=0)
    a, b, c, d = points[:, :-1], following[:, :-1], following[:, 1:], points[:, 1:]
    return halves(a, b, c, d)


def quads(*corners: tuple[Array, float, float]) -> Array:
    """Four corners (angle, height, offset) each; the angles are arrays, for as many quads."""
    a, b, c, d = (at(*corner) for corner in corners)
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
