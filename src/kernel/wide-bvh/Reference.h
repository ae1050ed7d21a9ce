// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryBox.h"

#include <bit>

namespace bwfirt::wide {

using namespace binary;

/// A plane perpendicular to an axis.
struct Plane {
    int axis;
    float position;
};

/// A triangle, or a part of it, in 32 bytes: the box of the part and the index of the triangle.
class Reference {
  public:
    Reference() = default;
    Reference(const Box& box, std::uint32_t triangle) : low_(box.low), high_(box.high) {
        low_[3] = std::bit_cast<float>(triangle);
    }

    Box box() const { return {__builtin_shufflevector(low_, low_, 0, 1, 2, 0), high_}; }
    std::uint32_t triangle() const { return std::bit_cast<std::uint32_t>(float(low_[3])); }

    /// A quarter of the sum of both corners, which is half of the box's centre: unlike the sum and
    /// the differences of such, it is always finite.
    Float4 halfCentre() const {
        const Box b = box();
        return 0.25f * b.low + 0.25f * b.high;
    }

  private:
    Float4 low_;  ///< the triangle's index in the bits of the fourth lane
    Float4 high_;
};
static_assert(sizeof(Reference) == 32);

/// Both parts of a reference that a plane cuts. Each box holds all points of the triangle on its
/// side within the reference's box, with a margin of at least a rounding error around the cut.
struct Parts {
    Reference below;
    Reference above;
};
Parts cut(const Reference& reference, const Triangle& triangle, const Plane& plane);

}  // namespace bwfirt::wide
