// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Random.h"
#include "math/Vector.h"

#include <cmath>

namespace bwfirt {

// These functions use only + - * / and square roots, which IEEE 754 rounds exactly: a path is the
// same to the bit on every machine, whatever its mathematical library.

/// A direction about the unit vector `normal` with density cos(theta) / pi per solid angle, by
/// Malley's method: a uniform point of the unit disc, found by rejection, is lifted to the
/// hemisphere (Pharr, Jakob, Humphreys: Physically Based Rendering, section "Cosine-weighted
/// hemisphere sampling"). The tangents are those of Duff et al.: "Building an orthonormal basis,
/// revisited", JCGT 6(1), 2017.
inline V3d sampleCosineHemisphere(const V3d& normal, Random& random) {
    double x, y, radiusSquared;
    do {
        const auto [u, v] = random.uniformSquare();
        x = 2 * u - 1;
        y = 2 * v - 1;
        radiusSquared = x * x + y * y;
    } while (radiusSquared >= 1);

    const double sign = std::copysign(1.0, normal.z);
    const double a = -1 / (sign + normal.z);
    const double b = normal.x * normal.y * a;
    const V3d tangent(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const V3d bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    return x * tangent + y * bitangent + std::sqrt(1 - radiusSquared) * normal;
}

/// A point of the triangle a b c, uniform in area (Turk: "Generating random points in triangles",
/// Graphics Gems, 1990).
inline V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, Random& random) {
    const auto [u, v] = random.uniformSquare();
    const double root = std::sqrt(u);
    return a + root * (b - a) + root * v * (c - b);
}

}  // namespace bwfirt
