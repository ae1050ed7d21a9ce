// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Node.h"
#include "kernel/qbvh/TreeRay.h"
#include "kernel/qbvh/Vectors.h"

#include <array>
#include <bit>

namespace bwfirt {

/// A ray prepared for tests against the boxes of nodes.
///
/// The distance to a plane is (node's origin + q * step - ray's origin) * inverse direction. The
/// tests are conservative (Ize: "Robust BVH ray traversal", JCGT 2(2), 2013): with the ray's origin
/// in [-2, 2] and nodes in [-1, 1], rounding moves a plane by less than 11 * 2^-24, for which
/// Node::MARGIN makes room, and changes the distance by less than 4 * 2^-24 of itself, for which
/// SLACK does.
class BoxRay {
  public:
    explicit BoxRay(const TreeRay& ray) {
        if (ray.isFar)
            return;  // all boxes are met at distance 0
        inverse_ = __builtin_convertvector(lesser(greater(ray.inverse, -MOST), MOST), Float4);
        stepInverse_ = __builtin_shufflevector(inverse_, inverse_, 3, 0, 1, 2);
        minusOrigin_ = -__builtin_convertvector(ray.origin, Float4) * inverse_;
        for (std::size_t axis = 0; axis < 3; ++axis)
            nearRows_[axis] = 2 * axis + (inverse_[static_cast<int>(axis)] < 0 ? 1 : 0);
    }

    /// Where the ray enters the boxes of the children, and which of them it meets up to tMax.
    struct Meeting {
        Int4 enter;  ///< distances not below 0, whose bits are ordered like them
        unsigned children;
    };
    [[gnu::always_inline]] Meeting meet(const Node& node, float tMax) const {
        const Float4 start = multiplyAdd(node.gridOrigin(), inverse_, minusOrigin_);
        const Float4 step = node.gridSteps() * stepInverse_;
        const Float4 startX = inAllLanes<0>(start), stepX = inAllLanes<1>(step);
        const Float4 startY = inAllLanes<1>(start), stepY = inAllLanes<2>(step);
        const Float4 startZ = inAllLanes<2>(start), stepZ = inAllLanes<3>(step);
        const auto plane = [&](std::size_t row, const Float4& first, const Float4& each) {
            return multiplyAdd(load(node.planes[row]), each, first);
        };
        const auto [x, y, z] = nearRows_;
        const Float4 enter = greater(greater(plane(x, startX, stepX), plane(y, startY, stepY)),
                                     greater(plane(z, startZ, stepZ), Float4{}));
        const Float4 leave =
            lesser(lesser(plane(x ^ 1, startX, stepX), plane(y ^ 1, startY, stepY)),
                   lesser(plane(z ^ 1, startZ, stepZ), Float4{tMax, tMax, tMax, tMax}));
        const Int4 enterBits = std::bit_cast<Int4>(enter);
        const Int4 areMissed = enterBits > std::bit_cast<Int4>(leave) + SLACK;
        return {enterBits, bitsOf(areMissed) ^ 15};
    }

    /// Units in the last place.
    static constexpr std::int32_t SLACK = 64;

  private:
    /// Takes the place of larger numbers, infinity above all: within 2^16 such a ray leaves its
    /// place on the axis by less than 2^-74.
    static constexpr Double4 MOST{0x1p90, 0x1p90, 0x1p90, 0x1p90};

    Float4 inverse_{}, stepInverse_{}, minusOrigin_{};
    std::array<std::size_t, 3> nearRows_{};  ///< of Node::planes
};

}  // namespace bwfirt
