# SPDX-License-Identifier: GPL-3.0-only
"""A roof above the stands, open above the pitch: trusses that cantilever from columns behind."""

import numpy as np

from model.meshes import X, joined, repeated, rotated
from model.shapes import box, quad, steps, surface, tubes

from . import plan

Array = np.ndarray

INNER, OUTER = 2.5, 38.0  # offsets of the edges
SKIN = 13.0  # where the skin begins; nearer to the pitch there are only slats
INNER_HEIGHT, OUTER_HEIGHT = 35.5, 32.0  # of the skin
RISE = 1.2  # of its middle above the straight line between
THICKNESS = 0.35
ROOT, TIP = 4.2, 0.9  # heights of a truss
PANELS = 9  # of a truss
CHORD, BRACE, RING = 0.17, 0.09, 0.11  # radii of tubes
FLOODLIGHTS = 4, 7  # rows and columns of lamps in a rack
TILT = 0.61  # of a rack, downwards


def skin_height(offset: Array | float) -> Array | float:
    t = (offset - INNER) / (OUTER - INNER)
    return INNER_HEIGHT + t * (OUTER_HEIGHT - INNER_HEIGHT) + 4 * RISE * t * (1 - t)


def lower_height(offset: Array | float) -> Array | float:
    """Of the lower chord of a truss."""
    t = (offset - INNER) / (OUTER - INNER)
    return skin_height(offset) - THICKNESS - TIP - (ROOT - TIP) * t * t


def skin(angles: Array, segments: int) -> Array:
    """Closed over the stands."""
    offset = SKIN + np.arange(segments + 1) * ((OUTER + 1 - SKIN) / segments)
    top = np.stack([offset, skin_height(offset)], axis=-1)
    bottom = top - np.array([0, THICKNESS])
    return plan.ring(np.concatenate([bottom[::-1], top, bottom[-1:]]), angles).reshape(-1, 3, 3)


def beams(angles: Array, offsets: Array, width: float, height: float) -> Array:
    """Along the rings, hanging from the level of the skin's underside."""
    return joined(plan.ring([(o, y), (o + width, y), (o + width, y - height), (o, y - height),
                             (o, y)], angles).reshape(-1, 3, 3)
                  for o, y in zip(offsets.tolist(), (skin_height(offsets) - THICKNESS).tolist()))


def tubes_between(starts: Array, ends: Array, radius: float, sides: int) -> Array:
    return tubes(np.stack([starts, ends], axis=-2), radius, sides, closed_ends=False)


def trusses(angles: Array, sides: int) -> Array:
    node = INNER + 0.3 + np.arange(PANELS + 1) * ((OUTER - INNER - 0.3) / PANELS)
    angles = angles[:, np.newaxis]
    upper = plan.at(angles, skin_height(node) - THICKNESS - CHORD, node)
    lower = plan.at(angles, lower_height(node), node)
    return joined(
        tubes(upper, CHORD, sides, closed_ends=False), tubes(lower, CHORD, sides),
        tubes_between(upper, lower, BRACE, sides),
        tubes_between(upper[:, :-1], lower[:, 1:], BRACE, sides))


def rings(angles: Array, sides: int) -> Array:
    """Tubes that join the trusses, at every third of their nodes."""
    offsets = INNER + 0.3 + np.arange(0, PANELS + 1, 3) * ((OUTER - INNER - 0.3) / PANELS)
    closed = np.append(angles, angles[0])
    return joined(tubes(plan.at(closed, lower_height(offset), offset), RING, sides,
                        closed_ends=False) for offset in offsets.tolist())


def columns(angles: Array, sides: int) -> Array:
    foot, head = plan.at(angles, 0.0, OUTER), plan.at(angles, skin_height(OUTER), OUTER)
    return tubes_between(foot, head, 2 * CHORD, sides)


def floodlight() -> Array:
    """A lamp that looks along z: a box that opens into a flat funnel."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    rims = np.stack([np.concatenate([corners * half, np.full((4, 1), z)], axis=1)
                     for half, z in ((0.13, -0.2), (0.13, 0.0), (0.2, 0.22))], axis=1)
    return joined(surface(rims, closed_u=True), quad(*rims[:, 0]), quad(*rims[:, 1]))


def rack() -> Array:
    """Rows of floodlights on a frame, that hang from the origin and look along z."""
    rows, across = FLOODLIGHTS
    lamps = [floodlight() + np.array([(i - (across - 1) / 2) * 0.5, -0.6 - 0.5 * j, 0.0])
             for i in range(across) for j in range(rows)]
    width, height = across * 0.25 + 0.1, rows * 0.5 + 0.4
    posts = [box((x - 0.05, -height, -0.32), (x + 0.05, 0.5, -0.22)) for x in (-width, 0, width)]
    beams = [box((-width, y - 0.04, -0.22), (width, y + 0.04, -0.16))
             for y in (-0.6 - 0.5 * np.arange(rows)).tolist()]
    return joined(lamps, posts, beams)


def floodlights() -> Array:
    """Racks between the trusses, tilted towards the pitch."""
    angles = plan.bays([0.5]).reshape(-1)
    offset = INNER + 0.8
    return repeated(rotated(rack(), X, TILT), plan.facing_in(angles),
                    plan.at(angles, skin_height(offset) - THICKNESS - 0.5, offset))


def roof(angles: Array, fineness: float) -> Array:
    """The skin's rings have corners at these angles."""
    parts = [skin(angles, steps(5 * fineness, 1))]
    if fineness > 0.07:
        parts.append(beams(angles, np.array([INNER]), 0.5, 1.1))
    if fineness > 0.28:
        stations, sides = plan.bays([0]).reshape(-1), steps(6 * fineness, 3)
        parts += [trusses(stations, sides), rings(angles, sides), columns(stations, sides)]
    if fineness > 0.35:
        purlins = SKIN + 2.0 + np.arange(8) * ((OUTER - SKIN - 2.0) / 8)
        slats = INNER + 1.2 + np.arange(12) * ((SKIN - INNER - 1.2) / 12)
        parts += [beams(angles, purlins, 0.2, 0.45), beams(angles, slats, 0.12, 0.3)]
    if fineness > 0.5:
        parts.append(floodlights())
    return joined(parts)
