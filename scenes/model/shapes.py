# SPDX-License-Identifier: GPL-3.0-only
"""Shapes as meshes. Corners run counterclockwise as seen from outside; y is up."""

import numpy as np

from . import vectors
from .portable import PI, cos, sin

Array = np.ndarray


def steps(ideal: float, least: int) -> int:
    """A whole number of segments: the nearest to an ideal one, but not fewer than the least."""
    return max(least, int(ideal + 0.5))


def circle(segments: int, radius: float = 1) -> Array:
    """Points (segments, 2), counterclockwise, without repeating the first."""
    angle = np.arange(segments) * (2 * PI / segments)
    return np.stack([radius * cos(angle), radius * sin(angle)], axis=-1)


def halves(a: Array, b: Array, c: Array, d: Array) -> Array:
    """The two triangles (..., 2, 3, 3) of each cell with these corners (..., 3)."""
    return np.stack([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)], axis=-3)


def surface(points: Array, closed_u: bool = False, closed_v: bool = False) -> Array:
    """Two triangles for each cell of a grid of points (nu, nv, 3); closed axes join up.

    Outside is the side from which u runs to the right and v upwards. Cells are parted along the
    diagonal from their first corner; triangles that collapse, as at the pole of a sphere, are left
    out.
    """
    points = np.asarray(points, dtype=float)
    if closed_u:
        points = np.concatenate([points, points[:1]])
    if closed_v:
        points = np.concatenate([points, points[:, :1]], axis=1)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    triangles = halves(a, b, c, d).reshape(-1, 3, 3)
    p, q, r = np.moveaxis(triangles.astype(np.float32), 1, 0)  # what will be written
    whole = ((p != q).any(axis=1) & (q != r).any(axis=1) & (r != p).any(axis=1))
    return triangles[whole]


def polygon(corners: Array) -> Array:
    """A flat polygon, convex or not, without holes, parted by cutting off ears."""
    corners = np.asarray(corners, dtype=float)
    following = np.roll(corners, -1, axis=0)
    normal = np.array([sum(c[i] for c in vectors.cross(corners, following).tolist())
                       for i in range(3)])
    rest, triangles = list(range(len(corners))), []

    def is_ear(a: int, b: int, c: int) -> bool:
        def side(p: int, q: int, r: int) -> float:
            return float(vectors.dot(vectors.cross(corners[q] - corners[p],
                                                   corners[r] - corners[p]), normal))
        if side(a, b, c) <= 0:
            return False
        return not any(side(a, b, p) >= 0 and side(b, c, p) >= 0 and side(c, a, p) >= 0
                       for p in rest if p not in (a, b, c))

    while len(rest) > 3:
        for i, b in enumerate(rest):
            a, c = rest[i - 1], rest[(i + 1) % len(rest)]
            if is_ear(a, b, c):
                break
        else:
            raise ValueError('the polygon crosses itself')
        triangles.append(corners[[a, b, c]])
        rest.remove(b)
    return np.array(triangles + [corners[rest]])


def quad(a: Array, b: Array, c: Array, d: Array) -> Array:
    return np.array([[a, b, c], [a, c, d]], dtype=float)


def box(low: Array, high: Array) -> Array:
    """Twelve triangles; axis-aligned."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    a, b, c, d = (x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)
    e, f, g, h = (x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)
    faces = [(a, b, c, d), (h, g, f, e), (d, c, g, h), (b, a, e, f), (a, d, h, e), (c, b, f, g)]
    return np.concatenate([quad(*face) for face in faces])


def lathe(profile: Array, segments: int) -> Array:
    """A surface of revolution about the y axis; the profile (n, 2) of radius and height runs
    upwards on its outer side."""
    profile = np.asarray(profile, dtype=float)
    ring = circle(segments)[::-1]  # so that u runs to the right as seen from outside
    radius, height = profile[:, 0], np.broadcast_to(profile[:, 1], (segments, len(profile)))
    return surface(np.stack([ring[:, :1] * radius, height, ring[:, 1:] * radius], axis=-1),
                   closed_u=True)


def smooth_lathe(profile: Array, points: int, segments: int) -> Array:
    """A lathe of so many points on a smooth curve through the profile."""
    curve = spline(profile, points)
    curve[:, 0] = np.maximum(curve[:, 0], 0)
    return lathe(curve, segments)


def cylinder(radius: float, bottom: float, top: float, segments: int) -> Array:
    """Upright on the y axis, with both ends closed."""
    return lathe([(0, bottom), (radius, bottom), (radius, top), (0, top)], segments)


def sphere(radius: float, segments: int) -> Array:
    """About the origin; `segments` meridians."""
    rings = max(2, segments // 2)
    angle = np.arange(1, rings) * (PI / rings) - PI / 2
    profile = np.stack([radius * cos(angle), radius * sin(angle)], axis=-1)
    return lathe([(0, -radius), *profile, (0, radius)], segments)


def rounded_box(low: Array, high: Array, radius: float, segments: int) -> Array:
    """A box with rounded edges and corners, of `segments` steps to each quarter turn."""
    (x0, y0, z0), (x1, y1, z1) = np.add(low, radius), np.subtract(high, radius)
    quarter = np.arange(segments + 1) / segments * (PI / 2)
    longitude = (quarter + np.arange(4)[:, np.newaxis] * (PI / 2)).reshape(-1, 1)
    latitude = np.concatenate([quarter - PI / 2, quarter])
    x = np.repeat([x1, x0, x0, x1], segments + 1)[:, np.newaxis]
    z = np.repeat([z1, z1, z0, z0], segments + 1)[:, np.newaxis]
    y = np.repeat([y0, y1], segments + 1)
    ring = np.broadcast_arrays(x + radius * cos(latitude) * cos(longitude),
                               y + radius * sin(latitude),
                               z + radius * cos(latitude) * sin(longitude))
    bottom, top = y0 - radius, y1 + radius
    return np.concatenate([
        surface(np.stack(ring, axis=-1)[::-1], closed_u=True),
        quad((x0, bottom, z0), (x1, bottom, z0), (x1, bottom, z1), (x0, bottom, z1)),
        quad((x0, top, z1), (x1, top, z1), (x1, top, z0), (x0, top, z0))])


def extruded(corners: Array, offset: Array) -> Array:
    """A flat polygon (n, 3) drawn along an offset, with both ends closed. The polygon runs
    counterclockwise as seen against the offset."""
    corners = np.asarray(corners, dtype=float)
    shifted = corners + np.asarray(offset)
    return np.concatenate([polygon(corners[::-1]), polygon(shifted),
                           surface(np.stack([corners, shifted], axis=1), closed_u=True)])


def tubes(paths: Array, radius: Array | float, segments: int, closed_ends: bool = True) -> Array:
    """Round tubes along paths (..., n, 3), all with the same number of points.

    The radius is one number, one for each point (n), or one for each point of each path (..., n).
    The rings do not twist: each is the one before, turned by the smallest rotation (the double
    reflection method of Wang et al., "Computation of Rotation Minimizing Frames", 2008).
    """
    paths = np.asarray(paths, dtype=float)
    paths = paths.reshape(-1, *paths.shape[-2:])
    count, n = paths.shape[:2]
    radius = np.broadcast_to(radius, (count, n)) if np.ndim(radius) < 2 else (
        np.asarray(radius).reshape(count, n))
    tangent = np.empty_like(paths)
    tangent[:, 1:-1] = paths[:, 2:] - paths[:, :-2]
    tangent[:, 0] = paths[:, 1] - paths[:, 0]
    tangent[:, -1] = paths[:, -1] - paths[:, -2]
    tangent = vectors.normalized(tangent)
    normal = np.empty_like(paths)
    normal[:, 0] = vectors.perpendicular(tangent[:, 0])
    for i in range(n - 1):
        step = paths[:, i + 1] - paths[:, i]
        turned, aim = _reflected(normal[:, i], step), _reflected(tangent[:, i], step)
        normal[:, i + 1] = _reflected(turned, tangent[:, i + 1] - aim)
    binormal = vectors.cross(tangent, normal)
    ring = circle(segments)
    points = (paths[:, np.newaxis] + radius[:, np.newaxis, :, np.newaxis] * (
        ring[:, 0, np.newaxis, np.newaxis] * normal[:, np.newaxis]
        + ring[:, 1, np.newaxis, np.newaxis] * binormal[:, np.newaxis]))
    if closed_ends:
        start, end = (np.broadcast_to(paths[:, np.newaxis, [i]], (count, segments, 1, 3))
                      for i in (0, -1))
        points = np.concatenate([start, points, end], axis=2)
    following = np.roll(points, -1, axis=1)
    a, b = points[:, :, :-1], following[:, :, :-1]
    c, d = following[:, :, 1:], points[:, :, 1:]
    triangles = halves(a, b, c, d)
    if closed_ends:  # the rings of the ends have one triangle for each segment
        return np.concatenate([triangles[:, :, :1, 1].reshape(-1, 3, 3),
                               triangles[:, :, 1:-1].reshape(-1, 3, 3),
                               triangles[:, :, -1:, 0].reshape(-1, 3, 3)])
    return triangles.reshape(-1, 3, 3)


def _reflected(vector: Array, normal: Array) -> Array:
    """Mirrored at the plane with that normal, of any length; unchanged where the normal is 0."""
    squared = vectors.dot(normal, normal)
    factor = 2 * vectors.dot(normal, vector) / np.where(squared > 0, squared, 1)
    return vector - factor[..., np.newaxis] * normal


def simplified(line: Array, tolerance: float) -> Array:
    """The fewest points of a line (n, 2) that Douglas and Peucker's method has to keep."""
    keep, spans = {0, len(line) - 1}, [(0, len(line) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        start, chord, between = line[first], line[last] - line[first], line[first + 1:last]
        norm = float(np.sqrt(chord[0] * chord[0] + chord[1] * chord[1])) or 1.0
        apart = np.abs((between[:, 0] - start[0]) * chord[1]
                       - (between[:, 1] - start[1]) * chord[0]) / norm
        farthest = int(np.argmax(apart))
        if apart[farthest] > tolerance:
            middle = first + 1 + farthest
            keep.add(middle)
            spans += [(first, middle), (middle, last)]
    return line[sorted(keep)]


def spline(points: Array, samples: int) -> Array:
    """A curve through points (..., n, d), sampled evenly in its parameter: (..., samples, d). It is
    Catmull and Rom's cubic."""
    points = np.asarray(points, dtype=float)
    before, after = 2 * points[..., :1, :] - points[..., 1:2, :], (
        2 * points[..., -1:, :] - points[..., -2:-1, :])
    p = np.concatenate([before, points, after], axis=-2)
    spans = points.shape[-2] - 1
    at = np.arange(samples) * (spans / (samples - 1))
    span = np.minimum(at.astype(np.int64), spans - 1)
    t = (at - span)[:, np.newaxis]
    a, b, c, d = (p[..., span + i, :] for i in range(4))
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
