// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/WatertightRay.h"
#include "kernel/wide-bvh/Simd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace bwfirt::wide {

/// Unit roundoff of single precision.
constexpr float ROUNDING = 0x1p-24F;

/// What the test of boxes needs of the points origin + t * direction along one axis: of a plane at
/// x the ray is at t = x * inverse - offset. The offsets of planes where a box is entered are so
/// much larger, of those where it is left so much smaller, that no rounding of single precision
/// makes the ray miss a box that it meets.
struct AxisConstants {
    float inverse, nearOffset, farOffset;
    /// Where a node's planes begin that are met first and last, in numbers from the first plane.
    std::uint32_t nearPlane, farPlane;
    std::uint32_t isBackwards;  ///< 1 where the direction is negative

    /// @param longest what the direction is along the axis where it is longest, up to its sign
    /// @param reach the largest coordinate of the scene, up to its sign
    AxisConstants(std::uint32_t axis, float origin, float direction, float longest, float reach) {
        // Less than this moves the ray by less than rounding does, and needs no infinity.
        const float least = longest * 0x1p-60F;
        inverse = 1 / std::copysign(std::max(std::abs(direction), least), direction);
        // The product x * inverse is rounded once and inverse once, the offset thrice, each time by
        // a share of |x * inverse| or |origin * inverse|; and so is the distance of a hit.
        const float error = 6 * ROUNDING * std::abs(inverse) * (std::abs(origin) + reach);
        nearOffset = origin * inverse + error;
        farOffset = origin * inverse - error;
        isBackwards = std::bit_cast<std::uint32_t>(direction) >> 31;
        constexpr auto PLANE = static_cast<std::uint32_t>(WIDTH);
        nearPlane = (axis + 3 * isBackwards) * PLANE;
        farPlane = (axis + 3 - 3 * isBackwards) * PLANE;
    }
};

/// What the tests of boxes and triangles need of the points origin + t * direction.
struct RayConstants {
    /// By axis: see AxisConstants.
    std::array<float, 3> inverse, nearOffset, farOffset;
    std::array<std::uint32_t, 3> nearPlane, farPlane;

    /// The axes, of which z is that along which the direction is longest, and the ray in them: see
    /// WatertightRay.
    int x, y, z;
    float originX, originY, originZ;
    float shearX, shearY, inverseZ;

    /// @param reach the largest coordinate of the scene, up to its sign
    RayConstants(const V3f& origin, const V3f& direction, float reach) {
        const V3f length(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
        const float longest = std::max({length.x, length.y, length.z});
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            const AxisConstants one(axis, origin[a], direction[a], longest, reach);
            inverse[axis] = one.inverse;
            nearOffset[axis] = one.nearOffset;
            farOffset[axis] = one.farOffset;
            nearPlane[axis] = one.nearPlane;
            farPlane[axis] = one.farPlane;
        }
        setTriangleAxes(longestAxis(length.x, length.y, length.z), origin, direction,
                        V3f(inverse[0], inverse[1], inverse[2]));
    }

    RayConstants() = default;

    /// @param inverseByAxis that of AxisConstants, by axis
    template <typename Vector>
    void setTriangleAxes(int longest, const Vector& origin, const Vector& direction,
                         const Vector& inverseByAxis) {
        z = longest;
        x = axisAfter(z);
        y = axisBefore(z);
        originX = origin[x];
        originY = origin[y];
        originZ = origin[z];
        inverseZ = inverseByAxis[z];
        shearX = direction[x] * inverseZ;
        shearY = direction[y] * inverseZ;
    }
};

}  // namespace bwfirt::wide
