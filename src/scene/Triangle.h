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
template <typename Number>
Vec3<Number> edgeCross(const Vec3<Number>& a, const Vec3<Number>& b, const Vec3<Number>& c) {
    return (b - a).cross(c - a);
}
inline V3d edgeCross(const Triangle& triangle) {
    return edgeCross(V3d(triangle.vertices[0]), V3d(triangle.vertices[1]),
                     V3d(triangle.vertices[2]));
}

/// The geometric normal of unit length, counter-clockwise vertices seen from its tip. NaN where the
/// triangle has no area.
inline V3d unitNormal(const Triangle& triangle) {
    const V3d normal = edgeCross(triangle);
    return normal * (1 / std::sqrt(normal.dot(normal)));
}

/// A normal of any length or its negative, whichever points against the direction, of unit length.
/// The side is found from the normal before it has unit length, so that neither waits for the
/// other.
template <typename Number>
Vec3<Number> unitAgainst(const Vec3<Number>& direction, const Vec3<Number>& normal) {
    using std::copysign, std::sqrt;
    const Number inverseLength = 1 / sqrt(normal.dot(normal));
    return normal * copysign(inverseLength, -normal.dot(direction));
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
