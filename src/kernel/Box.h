// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "scene/Triangle.h"

#include <limits>

namespace bwfirt {

inline Floats4 toFloats4(const V3f& v) {
    return Floats4([&](int i) { return i < 3 ? v[i] : 0.0F; });
}

inline V3f toV3f(const Floats4& v) {
    return {v[0], v[1], v[2]};
}

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

    int longestAxis() const {
        const Floats4 half = 0.5F * high - 0.5F * low;
        const int axis = half[0] > half[1] ? 0 : 1;
        return half[axis] > half[2] ? axis : 2;
    }

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
        const Floats4 corner = toFloats4(vertex);
        box.extend({corner, corner});
    }
    constexpr float STEP = std::numeric_limits<float>::epsilon();
    const float margin = 1e-12F * hmax(box.high - box.low);
    box.low -= STEP * abs(box.low) + margin;
    box.high += STEP * abs(box.high) + margin;
    return box;
}

}  // namespace bwfirt
