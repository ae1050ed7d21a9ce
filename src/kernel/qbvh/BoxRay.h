// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Node.h"

#include <algorithm>
#include <cmath>

#ifdef __FMA__
#include <immintrin.h>
#endif

namespace bwfirt {

/// The points origin + t * direction, t > 0, prepared for tests against the boxes of nodes.
///
/// The tests work in coordinates of the tree, in which the scene reaches from -1 to 1 and the
/// largest component of the direction is 1, so that nothing overflows. They are conservative. The
/// distance to a plane, (origin + q * step - ray origin) * inverse, carries less than 12 rounding
/// errors of its two summands. Where the ray starts farther from the node's origin than twice the
/// node's size, that is less than 24 rounding errors of the distance, for which SLACK makes room
/// (Ize: "Robust BVH ray traversal", JCGT 2(2), 2013). Where it starts nearer, that is less than
/// 2^-11 steps, for which Node::MARGIN does.
class BoxRay {
  public:
    BoxRay(const V3d& origin, const V3d& direction, double scale) {
        const double size =
            std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
        tScale_ = scale * size;
        bool isFar = false;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            origin_[i] = static_cast<float>(scale * origin[axis]);
            inverse_[i] = static_cast<float>(
                std::copysign(std::min(size / std::abs(direction[axis]), MOST), direction[axis]));
            nearPlanes_[i] = 2 * i + (inverse_[i] < 0 ? 1 : 0);
            isFar |= !(std::abs(origin_[i]) < FARTHEST);
        }
        if (isFar) {
            origin_.fill(0);
            inverse_.fill(0);  // where all boxes are met at distance 0
        }
    }

    /// The distance of a point of the ray in coordinates of the tree.
    float toTree(double t) const { return static_cast<float>(t * tScale_); }

    /// Where the ray enters the boxes of the children, and leaves them or reaches tMax. It misses
    /// those that it leaves before it enters them.
    struct Intervals {
        Floats4 enter;
        Floats4 leave;
        auto areMet() const { return enter <= leave; }
    };
    [[gnu::always_inline]] Intervals intersect(const Node& node, float tMax) const {
        Floats4 enter = 0, leave = tMax;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats4 step = Floats4(node.step[axis]) * inverse_[axis];
            const Floats4 origin =
                (Floats4(node.origin[axis]) - Floats4(origin_[axis])) * inverse_[axis];
            const std::size_t near = nearPlanes_[axis];
            enter = max(enter, multiplyAdd(toNumbers(node.planes[near]), step, origin));
            leave = min(leave, multiplyAdd(toNumbers(node.planes[near ^ 1]), step, origin));
        }
        return {enter, leave * SLACK};
    }

  private:
    [[gnu::always_inline]] static Floats4 toNumbers(
        const std::array<std::uint8_t, Node::WIDTH>& planes) {
        return Floats4(planes.data(), std::experimental::element_aligned);
    }

    /// a * b + c in one step where the processor has that; the bounds on errors hold for both.
    [[gnu::always_inline]] static Floats4 multiplyAdd(const Floats4& a, const Floats4& b,
                                                      const Floats4& c) {
#ifdef __FMA__
        return Floats4(
            _mm_fmadd_ps(static_cast<__m128>(a), static_cast<__m128>(b), static_cast<__m128>(c)));
#else
        return a * b + c;
#endif
    }

    static constexpr float SLACK = 1 + 32 * std::numeric_limits<float>::epsilon();
    /// Rays from farther away test all boxes.
    static constexpr float FARTHEST = 0x1p14F;
    /// Takes the place of larger numbers, infinity above all. On its way through the scene, less
    /// than 2 * FARTHEST, such a ray leaves its place on the axis by less than a margin.
    static constexpr double MOST = 0x1p90;
    static_assert(2 * FARTHEST / MOST < Node::LEAST_STEP * Node::MARGIN);

    std::array<float, 3> origin_;
    std::array<float, 3> inverse_;
    std::array<std::size_t, 3> nearPlanes_;  ///< index into Node::planes
    double tScale_;
};

}  // namespace bwfirt
