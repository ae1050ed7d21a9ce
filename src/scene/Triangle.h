// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <array>

namespace bwfirt {

/// Three vertices, just as they stand in a triangle file.
struct Triangle {
    std::array<V3f, 3> vertices;
};
static_assert(sizeof(Triangle) == 36, "a triangle is nine floats without padding");

/// (b - a) × (c - a): normal to the triangle, its length twice the area.
inline V3d edgeCross(const Triangle& triangle) {
    const V3d a(triangle.vertices[0]), b(triangle.vertices[1]), c(triangle.vertices[2]);
    return (b - a).cross(c - a);
}

/// The geometric normal of unit length, counter-clockwise vertices seen from its tip. NaN where the
/// triangle has no area.
inline V3d unitNormal(const Triangle& triangle) {
    const V3d normal = edgeCross(triangle);
    return normal * (1 / std::sqrt(normal.dot(normal)));
}

/// The same normal or its negative, whichever points against the direction. The side is found from
/// the normal before it has unit length, so that neither waits for the other.
inline V3d unitNormalAgainst(const V3d& direction, const Triangle& triangle) {
    const V3d normal = edgeCross(triangle);
    return normal * std::copysign(1 / std::sqrt(normal.dot(normal)), -normal.dot(direction));
}

/// In squared scene units.
inline double area(const Triangle& triangle) {
    const V3d normal = edgeCross(triangle);
    return std::sqrt(normal.dot(normal)) / 2;
}

/// False where a coordinate is infinite or NaN. Such a triangle is never hit.
inline bool isFinite(const Triangle& triangle) {
    return isFinite(triangle.vertices[0]) && isFinite(triangle.vertices[1]) &&
           isFinite(triangle.vertices[2]);
}

/// False for a triangle that no ray can hit: one without area or with a coordinate that is not
/// finite, with which the normal is not finite either.
inline bool hasArea(const Triangle& triangle) {
    const V3d normal = edgeCross(triangle);
    const double lengthSquared = normal.dot(normal);
    return lengthSquared > 0 && std::isfinite(lengthSquared);
}

}  // namespace bwfirt
