// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Bounds.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace bwfirt {

/// Sorts out triangles that a ray misses, four at once in single precision. What WatertightRay
/// would hit passes.
///
/// It computes what WatertightRay computes (Woop, Benthin and Wald: "Watertight ray/triangle
/// intersection", JCGT 2(1), 2013), and bounds the rounding errors. Where a number overflows, the
/// bound does too, and the triangle passes.
class TriangleFilter {
  public:
    TriangleFilter(const V3d& origin, const V3d& direction) {
        const V3d size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
        const std::size_t widest = size.y > size.x ? 1 : 0;
        z_ = size.z > size[static_cast<int>(widest)] ? 2 : widest;
        x_ = z_ == 2 ? 0 : z_ + 1;
        y_ = x_ == 2 ? 0 : x_ + 1;
        const auto at = [](const V3d& v, std::size_t axis) { return v[static_cast<int>(axis)]; };
        const double reciprocal = 1 / at(direction, z_);
        shearX_ = static_cast<float>(at(direction, x_) * reciprocal);
        shearY_ = static_cast<float>(at(direction, y_) * reciprocal);
        originX_ = static_cast<float>(at(origin, x_));
        originY_ = static_cast<float>(at(origin, y_));
        originZ_ = static_cast<float>(at(origin, z_));
        directionZ_ = at(direction, z_);
    }

    /// How far along its axis the ray gets up to t.
    float depth(double t) const { return static_cast<float>(t * directionZ_); }

    /// Which of the triangles of one to four indices the ray may meet up to a depth. The last index
    /// fills what is left.
    [[gnu::always_inline]] Floats4::mask_type mayMeet(std::span<const Triangle> triangles,
                                                      std::span<const std::uint32_t> indices,
                                                      float depth) const {
        using std::max, std::min;
        std::array<const float*, 4> first;
        for (std::size_t i = 0; i < 4; ++i)
            first[i] = &triangles[indices[std::min(i, indices.size() - 1)]].vertices[0].x;
        const auto along = [&](std::size_t vertex, std::size_t axis, float origin) {
            return Floats4([&](auto i) { return first[i][3 * vertex + axis]; }) - origin;
        };
        std::array<Floats4, 3> x, y, z;
        Floats4 width = 0, length = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            z[i] = along(i, z_, originZ_);
            x[i] = along(i, x_, originX_) - shearX_ * z[i];
            y[i] = along(i, y_, originY_) - shearY_ * z[i];
            width = max(width, max(abs(x[i]), abs(y[i])));
            length = max(length, abs(z[i]));
        }
        const Floats4 u = x[2] * y[1] - y[2] * x[1];
        const Floats4 v = x[0] * y[2] - y[0] * x[2];
        const Floats4 w = x[1] * y[0] - y[1] * x[0];
        const Floats4 least = min(min(u, v), w), most = max(max(u, v), w);

        // x and y have less than three epsilons of the coordinates that they are computed from,
        // which are not larger than `size`; and u, v and w have what follows from that.
        const Floats4 size = width + length;
        const Floats4 error = (width + 4 * EPSILON * size) * size * (16 * EPSILON) + TINY;

        // The plane is met behind the origin where `toOrigin` has not the sign of u, v and w, and
        // beyond the depth where `toDepth` has it.
        const Floats4 sign = depth < 0 ? -1 : 1;
        const Floats4 largest = max(abs(least), abs(most)) * (16 * EPSILON);
        const Floats4 toOrigin = sign * (u * z[0] + v * z[1] + w * z[2]);
        const Floats4 toOriginError = length * (3 * error + largest) + TINY;
        for (Floats4& fromDepth : z)
            fromDepth -= depth;
        const Floats4 toDepth = sign * (u * z[0] + v * z[1] + w * z[2]);
        const Floats4 reach = max(max(abs(z[0]), abs(z[1])), abs(z[2]));
        const Floats4 toDepthError = 3 * error * reach + largest * (length + reach) + TINY;

        const auto isMissedFromFront =
            (least < -error) | (toOrigin < -toOriginError) | (toDepth > toDepthError);
        const auto isMissedFromBack =
            (most > error) | (toOrigin > toOriginError) | (toDepth < -toDepthError);
        return !(isMissedFromFront & isMissedFromBack);
    }

  private:
    static constexpr float EPSILON = std::numeric_limits<float>::epsilon();
    /// More than what is lost where a product is too small for single precision.
    static constexpr float TINY = std::numeric_limits<float>::min();

    std::size_t x_, y_, z_;  ///< axes, z_ that of the direction's largest component
    float originX_, originY_, originZ_;
    float shearX_, shearY_;
    double directionZ_;
};

}  // namespace bwfirt
