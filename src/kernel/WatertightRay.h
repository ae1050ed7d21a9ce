// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Triangle4.h"
#include "math/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace bwfirt {

/// The axis along which a vector without negative components is longest; z, or else y, if several.
/// Which one it is cannot be predicted, and a product needs no branch.
template <typename Number>
int longestAxis(Number x, Number y, Number z) {
    return 2 - (std::max(x, y) > z ? 1 : 0) * (x > y ? 2 : 1);
}

/// The axes after and before one: x, y, z, and x again. Tables, for the same reason.
constexpr int axisAfter(int axis) {
    constexpr std::array<int, 3> AFTER = {1, 2, 0};
    return AFTER[static_cast<std::size_t>(axis)];
}
constexpr int axisBefore(int axis) {
    constexpr std::array<int, 3> BEFORE = {2, 0, 1};
    return BEFORE[static_cast<std::size_t>(axis)];
}

/// One triangle, where Number is double, or four of them, where it is Doubles4, as a ray sees them.
template <typename Number>
struct TriangleEdges {
    Number u, v, w;     ///< on which side the ray passes the edges opposite to a, b and c
    Number az, bz, cz;  ///< how far the vertices are along the ray's axis
    Number determinant;

    auto areMet() const {
        using std::max, std::min;
        const Number least = min(min(u, v), w), most = max(max(u, v), w);
        return ((least >= 0) | (most <= 0)) & (determinant != 0);
    }
    Number zTimesDeterminant() const { return u * az + v * bz + w * cz; }
};

/// The points origin + t * direction, t > 0, prepared for tests against triangles in double
/// precision, one by one or four at once. The direction may have any length. Kernels that use this
/// test differ from each other in nothing but their acceleration structures.
///
/// The test is that of Woop, Benthin and Wald: "Watertight ray/triangle intersection", JCGT 2(1),
/// 2013. It sees the triangle from the ray's origin, sheared such that the ray runs along an axis;
/// the ray meets the triangle where it passes all three edges on the same side. Both triangles at
/// a shared edge compute it from the same numbers, up to the sign, so that no ray passes between
/// them. That holds as long as the compiler does not fuse a product with the sum that follows:
/// SConstruct says -ffp-contract=off.
class WatertightRay {
  public:
    WatertightRay(const V3d& origin, const V3d& direction)
        : origin_(origin), direction_(direction) {
        kz_ = longestAxis(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
        kx_ = axisAfter(kz_);
        ky_ = axisBefore(kz_);
        shearX_ = direction[kx_] / direction[kz_];
        shearY_ = direction[ky_] / direction[kz_];
        originX_ = origin[kx_];
        originY_ = origin[ky_];
        originZ_ = origin[kz_];
        directionZ_ = direction[kz_];
    }

    const V3d& origin() const { return origin_; }
    const V3d& direction() const { return direction_; }

    /// The t in (0, infinity) at which the ray meets the triangle, from either side. Nothing for a
    /// ray in the triangle's plane, and wherever a NaN takes part.
    std::optional<double> intersect(const Triangle& triangle) const {
        const auto edges = edgesOf<double>([&](std::size_t vertex, int axis) {
            return static_cast<double>(triangle.vertices[vertex][axis]);
        });
        if (!edges.areMet())
            return std::nullopt;
        // That the triangle is behind the ray shows before the divisions have an end.
        const double zTimesDeterminant = edges.zTimesDeterminant();
        if (std::signbit(zTimesDeterminant) ^ std::signbit(edges.determinant) ^
            std::signbit(directionZ_))
            return std::nullopt;
        const double t = zTimesDeterminant / edges.determinant / directionZ_;
        if (!(t > 0))
            return std::nullopt;
        return t;
    }

    /// Where a ray meets the nearest of several triangles.
    struct Meeting {
        double t;
        std::uint32_t triangle;  ///< index into the triangles of kernelInitialize
    };

    /// The nearest of the four triangles that the ray meets with t in (tMin, tMax). Each t is that
    /// of the function above, to the bit.
    std::optional<Meeting> intersect(const Triangle4& triangles, double tMin, double tMax) const {
        const auto edges = edgesOf<Doubles4>(
            [&](std::size_t vertex, int axis) { return triangles.coordinates(vertex, axis); });
        const auto areMet = edges.areMet();
        if (none_of(areMet))
            return std::nullopt;
        const Doubles4 t = edges.zTimesDeterminant() / edges.determinant / directionZ_;
        const auto areInReach = areMet & (t > tMin) & (t < tMax);
        if (none_of(areInReach))
            return std::nullopt;
        int nearest = find_first_set(areInReach);
        for (int i = nearest + 1; i <= find_last_set(areInReach); ++i)
            if (areInReach[i] && t[i] < t[nearest])
                nearest = i;
        return Meeting{t[nearest], triangles.index(nearest)};
    }

  private:
    /// @param coordinate (vertex, axis) -> Number
    template <typename Number, typename Coordinate>
    TriangleEdges<Number> edgesOf(const Coordinate& coordinate) const {
        const auto along = [&](std::size_t vertex, int axis, double origin) -> Number {
            return coordinate(vertex, axis) - origin;
        };
        const Number az = along(0, kz_, originZ_);
        const Number bz = along(1, kz_, originZ_);
        const Number cz = along(2, kz_, originZ_);
        const Number ax = along(0, kx_, originX_) - shearX_ * az;
        const Number bx = along(1, kx_, originX_) - shearX_ * bz;
        const Number cx = along(2, kx_, originX_) - shearX_ * cz;
        const Number ay = along(0, ky_, originY_) - shearY_ * az;
        const Number by = along(1, ky_, originY_) - shearY_ * bz;
        const Number cy = along(2, ky_, originY_) - shearY_ * cz;

        const Number u = cx * by - cy * bx;
        const Number v = ax * cy - ay * cx;
        const Number w = bx * ay - by * ax;
        return {u, v, w, az, bz, cz, u + v + w};
    }

    V3d origin_;
    V3d direction_;
    int kx_, ky_, kz_;                    ///< axes, kz_ that of the direction's largest component
    double originX_, originY_, originZ_;  ///< along those axes
    double directionZ_;
    double shearX_, shearY_;
};

}  // namespace bwfirt
