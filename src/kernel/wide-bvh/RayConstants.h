// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "kernel/WatertightRay.h"
#include "kernel/wide-bvh/Simd.h"
#include "math/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace bwfirt::wide {

/// Unit roundoff of single precision.
constexpr float ROUNDING = 0x1p-24F;

/// What the test of boxes needs of the points origin + t * direction along one axis, where Number
/// is float, or along all of them at once, where it is Floats4: of a plane at x the ray is at
/// t = x * inverse - offset. The offsets of planes where a box is entered are so much larger, of
/// those where it is left so much smaller, that no rounding of single precision makes the ray miss
/// a box that it meets.
template <typename Number>
struct AxisConstants {
    using Index = std::conditional_t<std::is_same_v<Number, float>, std::uint32_t,
                                     std::experimental::rebind_simd_t<std::uint32_t, Floats4>>;

    Number inverse, nearOffset, farOffset;
    /// Where a node's planes begin that are met first and last, in numbers from the first plane.
    Index nearPlane, farPlane;
    Index isBackwards;  ///< 1 where the direction is negative

    /// @param longest what the direction is along the axis where it is longest, up to its sign
    /// @param reach the largest coordinate of the scene, up to its sign
    AxisConstants(Index axis, Number origin, Number direction, float longest, float reach) {
        using std::abs, std::copysign, std::max;
        // Less than this moves the ray by less than rounding does, and needs no infinity.
        const Number least = longest * 0x1p-60F;
        inverse = 1 / copysign(max(Number(abs(direction)), least), direction);
        // The product x * inverse is rounded once and inverse once, the offset thrice, each time by
        // a share of |x * inverse| or |origin * inverse|; and so is the distance of a hit.
        const Number error = 6 * ROUNDING * abs(inverse) * (abs(origin) + reach);
        nearOffset = origin * inverse + error;
        farOffset = origin * inverse - error;
        isBackwards = sameBits<Index>(direction) >> 31;
        constexpr auto PLANE = static_cast<std::uint32_t>(WIDTH);
        nearPlane = (axis + 3 * isBackwards) * PLANE;
        farPlane = (axis + 3 - 3 * isBackwards) * PLANE;
    }
};

/// What the tests of boxes and triangles need of the points origin + t * direction.
struct RayConstants {
    static constexpr std::size_t LANES = 4;  ///< of which three are axes

    /// By axis: see AxisConstants.
    std::array<float, LANES> inverse, nearOffset, farOffset;
    std::array<std::uint32_t, LANES> nearPlane, farPlane;

    /// The axes, of which z is that along which the direction is longest, and the ray in them: see
    /// WatertightRay.
    int x, y, z;
    float originX, originY, originZ;
    float shearX, shearY, inverseZ;

    bool canBeAsked;  ///< the ray's numbers are finite, and it has a direction

    /// @param reach the largest coordinate of the scene, up to its sign
    RayConstants(const V3f& origin, const V3f& direction, float reach) {
        const auto byAxis = [](const V3f& v) {
            return Floats4([&v](auto lane) { return v[std::min<int>(lane, 2)]; });
        };
        const Floats4 origins = byAxis(origin), directions = byAxis(direction);
        const Floats4 lengths = abs(directions);
        const float longest = hmax(lengths);
        using Axes = AxisConstants<Floats4>;
        const Axes::Index axis([](auto lane) { return static_cast<std::uint32_t>(lane); });
        const Axes axes(axis, origins, directions, longest, reach);
        const auto keep = [](const auto& numbers, auto& target) {
            numbers.copy_to(target.data(), std::experimental::element_aligned);
        };
        keep(axes.inverse, inverse);
        keep(axes.nearOffset, nearOffset);
        keep(axes.farOffset, farOffset);
        keep(axes.nearPlane, nearPlane);
        keep(axes.farPlane, farPlane);
        setTriangleAxes(longestAxis<float>(lengths[0], lengths[1], lengths[2]), origin, direction,
                        inverse);
        canBeAsked = all_of(0 * origins + 0 * directions == 0) && longest > 0;
    }

    RayConstants() = default;

    /// @param origin, direction, inverses by axis
    template <typename Vector, typename Inverses>
    void setTriangleAxes(int longest, const Vector& origin, const Vector& direction,
                         const Inverses& inverses) {
        z = longest;
        x = axisAfter(z);
        y = axisBefore(z);
        originX = origin[x];
        originY = origin[y];
        originZ = origin[z];
        inverseZ = inverses[static_cast<std::size_t>(z)];
        shearX = direction[x] * inverseZ;
        shearY = direction[y] * inverseZ;
    }
};

}  // namespace bwfirt::wide
