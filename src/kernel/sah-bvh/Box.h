// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Triangle.h"

#include <experimental/simd>

#include <limits>

namespace bwfirt {

/// Four numbers that an instruction of the processor computes at once, where it has such.
using Floats4 = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

/// An axis-aligned box in single precision: x, y, z and a fourth number that means nothing.
struct Box {
    Floats4 low = std::numeric_limits<float>::infinity();
    Floats4 high = -std::numeric_limits<float>::infinity();

    [[gnu::always_inline]] void extend(const Box& other) {
        low = min(low, other.low);
        high = max(high, other.high);
    }

    bool isEmpty() const { return low[0] > high[0]; }

    Floats4 centre() const { return 0.5F * low + 0.5F * high; }

    /// In double precision, where it does not overflow.
    double halfArea() const {
        const auto length = [&](int axis) { return static_cast<double>(high[axis]) - low[axis]; };
        return length(0) * length(1) + length(1) * length(2) + length(2) * length(0);
    }
};

/// The box of a triangle, larger on all sides by a step of single precision and by more than the
/// rounding errors of WatertightRay: what that finds just beside a triangle must not be lost at the
/// triangle's box.
inline Box boxOf(const Triangle& triangle) {
    Box box;
    for (const V3f& vertex : triangle.vertices) {
        const Floats4 corner([&](int axis) { return axis < 3 ? vertex[axis] : 0; });
        box.extend({corner, corner});
    }
    constexpr float STEP = std::numeric_limits<float>::epsilon();
    const float margin = 1e-12F * hmax(box.high - box.low);
    box.low -= STEP * abs(box.low) + margin;
    box.high += STEP * abs(box.high) + margin;
    return box;
}

}  // namespace bwfirt
