// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "math/Vector.h"

#include <limits>

namespace bwfirt {

inline Floats4 toFloats4(const V3f& v) {
    return Floats4([&](int i) { return i < 3 ? v[i] : 0.0F; });
}

inline V3f toV3f(const Floats4& v) {
    return {v[0], v[1], v[2]};
}

/// An axis-aligned box in registers. The fourth lane is 0, or infinite where the box is empty.
struct Bounds {
    Floats4 low = std::numeric_limits<float>::infinity();
    Floats4 high = -std::numeric_limits<float>::infinity();

    void extend(const Bounds& other) {
        low = min(low, other.low);
        high = max(high, other.high);
    }
};

/// Half of the surface of a box. Infinite where it is beyond single precision.
inline float halfArea(const Bounds& bounds) {
    const Floats4 size = bounds.high - bounds.low;
    return size[0] * (size[1] + size[2]) + size[1] * size[2];
}

}  // namespace bwfirt
