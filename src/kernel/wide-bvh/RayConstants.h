// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/WatertightRay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bwfirt::wide {

/// What the tests of boxes and triangles need of the points origin + t * direction.
struct RayConstants {
    /// Unit roundoff of single precision.
    static constexpr float ROUNDING = 0x1p-24F;

    /// Of a plane at x along an axis, the ray is at t = x * inverse - offset. The offsets of planes
    /// where a box is entered are so much larger, of those where it is left so much smaller, that
    /// no rounding of single precision makes the ray miss a box that it meets.
    std::array<float, 3> inverse, nearOffset, farOffset;
    std::array<std::size_t, 3> nearPlane, farPlane;  ///< which of a node's planes come first

    /// The axes, of which z is that along which the direction is longest, and the ray in them: see
    /// WatertightRay.
    int x, y, z;
    float originX, originY, originZ;
    float shearX, shearY, inverseZ;

    /// @param reach the largest coordinate of the scene, up to its sign
    RayConstants(const V3f& origin, const V3f& direction, float reach) {
        const V3f length(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
        const float longest = std::max({length.x, length.y, length.z});
        for (int axis = 0; axis < 3; ++axis) {
            // Less than this moves the ray by less than rounding does, and needs no infinity.
            const float least = longest * 0x1p-60F;
            const auto i = static_cast<std::size_t>(axis);
            inverse[i] = 1 / std::copysign(std::max(length[axis], least), direction[axis]);
            // The product x * inverse is rounded once and inverse once, the offset thrice, each
            // time by a share of |x * inverse| or |origin * inverse|.
            const float error =
                6 * ROUNDING * std::abs(inverse[i]) * (std::abs(origin[axis]) + reach);
            nearOffset[i] = origin[axis] * inverse[i] + error;
            farOffset[i] = origin[axis] * inverse[i] - error;
            const bool isBackwards = std::signbit(direction[axis]);
            nearPlane[i] = i + (isBackwards ? 3 : 0);
            farPlane[i] = i + (isBackwards ? 0 : 3);
        }
        z = longestAxis(length);
        x = axisAfter(z);
        y = axisBefore(z);
        originX = origin[x];
        originY = origin[y];
        originZ = origin[z];
        inverseZ = inverse[static_cast<std::size_t>(z)];
        shearX = direction[x] * inverseZ;
        shearY = direction[y] * inverseZ;
    }
};

}  // namespace bwfirt::wide
