// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Random.h"
#include "math/Vector.h"

#include <cmath>
#include <experimental/simd>
#include <utility>

namespace bwfirt {

// These functions use only + - * / and square roots, which IEEE 754 rounds exactly: a path is the
// same to the bit on every machine, whatever its mathematical library.

/// A uniform point (x, y) of the unit disc, found by rejection.
template <typename Bits, typename Number>
std::pair<Number, Number> sampleDisc(RandomOf<Bits, Number>& random) {
    using std::experimental::all_of;
    for (;;) {
        const auto [u, v] = random.uniformSquare();
        const Number x = 2 * u - 1;
        const Number y = 2 * v - 1;
        const Number beyond = x * x + y * y - 1;
        if (all_of(beyond < 0))
            return {x, y};
        // A path whose point is within draws it once more while others go on.
        random.stepBack(sameBits<Bits>(beyond) >> 63);
    }
}

/// A direction about the unit vector `normal` with density cos(theta) / pi per solid angle, by
/// Malley's method: a uniform point of the unit disc is lifted to the hemisphere (Pharr, Jakob,
/// Humphreys: Physically Based Rendering, section "Cosine-weighted hemisphere sampling"). The
/// tangents are those of Duff et al.: "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
template <typename Number>
Vec3<Number> cosineHemisphere(const Vec3<Number>& normal, const Number& x, const Number& y) {
    using std::copysign, std::sqrt;
    const Number sign = copysign(Number(1), normal.z);
    const Number a = -1 / (sign + normal.z);
    const Number b = normal.x * normal.y * a;
    const Vec3<Number> tangent(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const Vec3<Number> bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const Number height = sqrt(1 - (x * x + y * y));
    return x * tangent + y * bitangent + height * normal;
}

/// The point of the triangle a b c to which (u, v) belongs. A uniform point of the square [0, 1)^2
/// gives one that is uniform in area (Turk: "Generating random points in triangles", Graphics Gems,
/// 1990).
template <typename Number>
Vec3<Number> pointOfTriangle(const Vec3<Number>& a, const Vec3<Number>& ab, const Vec3<Number>& bc,
                             const Number& u, const Number& v) {
    using std::sqrt;
    const Number root = sqrt(u);
    return a + root * ab + root * v * bc;
}

}  // namespace bwfirt
