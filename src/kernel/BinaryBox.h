// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"
#include "kernel/Simd4.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace bwfirt::binary {

/// Points fill three lanes, and the fourth repeats x.
inline Float4 toFloat4(const V3f& v) {
    return Float4{v.x, v.y, v.z, v.x};
}
/// The three numbers at an address behind which a fourth one stands.
inline Float4 loadFloat4(const V3f& v) {
    Float4 result;
    std::memcpy(&result, &v, sizeof result);
    return __builtin_shufflevector(result, result, 0, 1, 2, 0);
}
inline V3f toV3f(const Float4& v) {
    return {v[0], v[1], v[2]};
}

inline constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// A box to compute with.
struct Box {
    Float4 low;
    Float4 high;

    static Box empty() { return {Float4{} + INFINITE, Float4{} - INFINITE}; }

    void extend(const Float4& point) {
        low = lesser(point, low);
        high = greater(point, high);
    }
    void extend(const Box& other) {
        low = lesser(other.low, low);
        high = greater(other.high, high);
    }
    void intersect(const Box& other) {
        low = greater(other.low, low);
        high = lesser(other.high, high);
    }
    bool isEmpty() const {
        const Int4 isIn = low <= high;
        return (isIn[0] & isIn[1] & isIn[2]) == 0;
    }

    Bounds bounds() const { return {toV3f(low), toV3f(high)}; }
    static Box of(const BinaryNode& node) {
        return {loadFloat4(node.bounds.low), loadFloat4(node.bounds.high)};
    }

    double length(int axis) const { return static_cast<double>(high[axis]) - low[axis]; }

    /// Half of the surface area.
    double halfArea() const {
        return length(0) * length(1) + length(1) * length(2) + length(2) * length(0);
    }

    /// The same in single precision, of a box that is `scale` times as large.
    float halfArea(float scale) const {
        const Float4 size = high * scale - low * scale;
        const Float4 sides = size * __builtin_shufflevector(size, size, 1, 2, 0, 1);
        return sides[0] + sides[1] + sides[2];
    }

    /// A power of two that makes the longest side of this box about 1: areas of boxes within it
    /// then neither overflow nor vanish.
    float scale() const {
        const double longest = std::max({length(0), length(1), length(2)});
        const int exponent = longest > 0 ? std::ilogb(longest) : 0;
        return static_cast<float>(std::ldexp(1.0, std::clamp(-exponent, -126, 126)));
    }
};

}  // namespace bwfirt::binary
