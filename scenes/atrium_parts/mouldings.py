# SPDX-License-Identifier: GPL-3.0-only
"""Profiles drawn along rings and arches, and walls with arched openings.

A profile (n, 2) is how far it stands out of the wall, and how high it lies.
"""

import numpy as np

from model.meshes import joined
from model.portable import PI, cos, sin
from model.shapes import quad, surface

from .plan import HALF_X, HALF_Z

Array = np.ndarray


def ring(profile: Array, w: float) -> Array:
    """A profile drawn around the court on walls at depth w; it stands out towards the court."""
    profile = np.asarray(profile, dtype=float)
    x, z = HALF_X + w - profile[:, 0], HALF_Z + w - profile[:, 0]
    corners = [np.stack([sx * x, profile[:, 1], sz * z], axis=-1)
               for sx, sz in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    return surface(np.array(corners), closed_u=True)


def square(profile: Array) -> Array:
    """A profile of half widths and heights drawn around a square on the y axis."""
    profile = np.asarray(profile, dtype=float)
    corners = [np.stack([sx * profile[:, 0], profile[:, 1], sz * profile[:, 0]], axis=-1)
               for sx, sz in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    return surface(np.array(corners), closed_u=True)


def arc(radius: float, rise: float, segments: int) -> Array:
    """Points (segments + 1, 2) of half an ellipse about the origin, from the left to the right."""
    angle = PI - np.arange(segments + 1) * (PI / segments)
    return np.stack([radius * cos(angle), rise * sin(angle)], axis=-1)


def archivolt(profile: Array, radius: float, spring: float, segments: int,
              sill: float | None = None) -> Array:
    """A moulding around an arch in the plane w = 0, standing out to -w, its heights measured from
    the edge of the opening. With a sill it also runs down along both jambs."""
    normals = arc(1, 1, segments)
    heights = np.full(len(normals), spring)
    if sill is not None:
        normals = np.concatenate([normals[:1], normals, normals[-1:]])
        heights = np.concatenate([[sill], heights, [sill]])
    profile = np.asarray(profile, dtype=float)
    reach = radius + profile[:, 1]
    return surface(np.stack(np.broadcast_arrays(
        normals[:, :1] * reach, heights[:, np.newaxis] + normals[:, 1:] * reach, -profile[:, 0]),
        axis=-1))


def spandrel(width: float, top: float, opening: Array, spring: float, w: float) -> Array:
    """A wall in the plane w above an arched opening."""
    low = np.concatenate([[(-width / 2, 0)], opening, [(width / 2, 0)]]) + np.array([0, spring])
    high = np.stack([low[:, 0], np.full(len(low), top)], axis=-1)
    outline = np.stack([low, high], axis=1)
    return surface(np.concatenate([outline, np.full((len(low), 2, 1), w)], axis=-1))


def soffit(opening: Array, spring: float, front: float, back: float) -> Array:
    """The underside of an arch."""
    points = np.empty((len(opening), 2, 3))
    points[:, :, 0] = opening[:, :1]
    points[:, :, 1] = opening[:, 1:] + spring
    points[:, :, 2] = [front, back]
    return surface(points)


def pierced_wall(width: float, bottom: float, top: float, radius: float, sill: float,
                 spring: float, segments: int) -> Array:
    """A wall in the plane w = 0 around an opening with a round head."""
    def panel(u0: float, u1: float, y0: float, y1: float) -> Array:
        return quad((u0, y0, 0), (u1, y0, 0), (u1, y1, 0), (u0, y1, 0))
    parts = [spandrel(width, top, arc(radius, radius, segments), spring, 0),
             panel(-width / 2, -radius, bottom, spring), panel(radius, width / 2, bottom, spring)]
    if sill > bottom:
        parts.append(panel(-radius, radius, bottom, sill))
    return joined(parts)


def jambs(radius: float, sill: float, spring: float, depth: float, segments: int) -> Array:
    """The sides of an opening with a round head, from w = 0 to its depth, and its sill."""
    opening = arc(radius, radius, segments)
    outline = np.concatenate([[(radius, sill - spring), (-radius, sill - spring)], opening,
                              [(radius, sill - spring)]])
    return soffit(outline, spring, 0, depth)
