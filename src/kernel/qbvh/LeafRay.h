// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Leaf.h"
#include "kernel/qbvh/TreeRay.h"

#include <array>
#include <cmath>

namespace bwfirt {

/// A ray prepared for tests against all triangles of a leaf at once, as they stand on its grid.
///
/// The test is that of WatertightRay (Woop, Benthin and Wald: "Watertight ray/triangle
/// intersection", JCGT 2(1), 2013) with bounds on what it cannot know. Half a step is the error of
/// a coordinate on the grid. As the ray sees them, x, y and t of the vertices are sums of numbers
/// up to 6, since the ray starts in [-2, 2], and rounding adds less than 26 * 2^-24. Where x and y
/// are off by dx and dy, the two products of an edge's sign with their difference are off by at
/// most 2 (dx Y + dy X + dx dy), with X and Y the largest of them.
class LeafRay {
  public:
    explicit LeafRay(const TreeRay& ray)
        : origin_(__builtin_convertvector(ray.origin, Float4)),
          shear_(__builtin_convertvector(
              ray.direction * std::copysign(1.0, ray.direction[ray.axis]), Float4)),
          sign_(ray.direction[ray.axis] < 0 ? -1.0F : 1.0F),
          untold_(ray.isFar ? ~0U : 0U) {
        shear_[ray.axis] = 0;
        x_ = static_cast<std::size_t>(axisAfter(ray.axis));
        y_ = static_cast<std::size_t>(axisBefore(ray.axis));
        z_ = static_cast<std::size_t>(ray.axis);
    }

    /// A bit for each triangle that the ray may meet with t in (0, tMax), and for each of those
    /// that it does meet.
    struct Meeting {
        unsigned possible;
        unsigned certain;
    };
    [[gnu::always_inline]] Meeting meet(const LeafGrid& grid, const Leaf& leaf, float tMax) const {
        const auto axisX = static_cast<int>(x_), axisY = static_cast<int>(y_);
        const auto axisZ = static_cast<int>(z_);
        // Where the ray passes the plane through the grid's origin across its own axis.
        const Float4 toOrigin = grid.origin - origin_;
        const Float4 offset = toOrigin - shear_ * toOrigin[axisZ];
        const Float4 shear = shear_ * -grid.step[axisZ];
        const Float4 error = HALF_STEP * (grid.step + absolute(shear)) + ROUNDING;
        std::array<Float8, 3> x, y, t;
        for (std::size_t vertex = 0; vertex < 3; ++vertex) {
            const Float8 stepsZ = loadEight(leaf.row(z_, vertex));
            const auto across = [&](std::size_t row, int axis) {
                return multiplyAdd(
                    loadEight(leaf.row(row, vertex)), inEightLanes(grid.step[axis]),
                    multiplyAdd(stepsZ, inEightLanes(shear[axis]), inEightLanes(offset[axis])));
            };
            x[vertex] = across(x_, axisX);
            y[vertex] = across(y_, axisY);
            t[vertex] = multiplyAdd(stepsZ, inEightLanes(sign_ * grid.step[axisZ]),
                                    inEightLanes(sign_ * offset[axisZ]));
        }
        const Float8 u = x[2] * y[1] - y[2] * x[1];
        const Float8 v = x[0] * y[2] - y[0] * x[2];
        const Float8 w = x[1] * y[0] - y[1] * x[0];
        const Float8 least = lesser(lesser(u, v), w), most = greater(greater(u, v), w);
        const Float8 errorX = inEightLanes(error[axisX]), errorY = inEightLanes(error[axisY]);
        const auto [leastX, mostX] = extent(x);
        const auto [leastY, mostY] = extent(y);
        const auto [first, last] = extent(t);
        // Of a triangle of few steps the edges' signs say nothing, wherever it is.
        const Int8 isClose =
            (leastX <= errorX) & (mostX >= -errorX) & (leastY <= errorY) & (mostY >= -errorY);
        const Float8 edgeError = 2 * multiplyAdd(errorX, greater(mostY, -leastY) + errorY,
                                                 errorY * greater(mostX, -leastX));
        const float errorT = error[axisZ] + ROUNDING * static_cast<float>(TreeRay::BEYOND);
        const Int8 possible = isClose & ((least >= -edgeError) | (most <= edgeError)) &
                              (last >= -errorT) & (first <= tMax + errorT);
        const Int8 certain = possible & ((least > edgeError) | (most < -edgeError)) &
                             (first > errorT) & (last < tMax - errorT);
        const unsigned areThere = (1U << leaf.count()) - 1;
        return {(bitsOf(possible) | untold_) & areThere, bitsOf(certain) & ~untold_ & areThere};
    }

  private:
    /// And what the grid's own rounding adds.
    static constexpr float HALF_STEP = 0.502F;
    static constexpr float ROUNDING = 0x1p-19F;

    struct Extent {
        Float8 least, most;
    };
    [[gnu::always_inline]] static Extent extent(const std::array<Float8, 3>& a) {
        return {lesser(lesser(a[0], a[1]), a[2]), greater(greater(a[0], a[1]), a[2])};
    }

    Float4 origin_, shear_;
    std::size_t x_, y_, z_;  ///< axes, z_ that of the direction's largest component
    float sign_;             ///< of the direction along z_
    unsigned untold_;        ///< bits of triangles of which nothing can be said: all or none
};

}  // namespace bwfirt
