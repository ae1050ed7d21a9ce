// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

// What builders of trees over boxes have in common.

namespace bwfirt {

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
        const Floats4 corner([&](int axis) { return axis < 3 ? vertex[axis] : 0; });
        box.extend({corner, corner});
    }
    constexpr float STEP = std::numeric_limits<float>::epsilon();
    const float margin = 1e-12F * hmax(box.high - box.low);
    box.low -= STEP * abs(box.low) + margin;
    box.high += STEP * abs(box.high) + margin;
    return box;
}

/// A triangle in a list to be sorted: its box, empty where it cannot be hit, with its index in the
/// fourth number.
class Reference {
  public:
    Reference(const Triangle& triangle, std::uint32_t index)
        : box_(hasArea(triangle) ? boxOf(triangle) : Box()) {
        box_.low[3] = std::bit_cast<float>(index);
    }

    /// With the bits of the index, a tiny number, with which processors compute slowly.
    const Box& boxWithIndex() const { return box_; }
    Box box() const {
        return {Floats4([&](auto i) { return i < 3 ? box_.low[i] : 0.0F; }), box_.high};
    }
    float centre(int axis) const { return 0.5F * box_.low[axis] + 0.5F * box_.high[axis]; }
    std::uint32_t triangle() const { return std::bit_cast<std::uint32_t>(float(box_.low[3])); }

    /// By vectors, as everything else reads and writes references: what has just been written in
    /// another size has to reach the cache before it can be read.
    friend void swap(Reference& a, Reference& b) {
        std::swap(a.box_.low, b.box_.low);
        std::swap(a.box_.high, b.box_.high);
    }

  private:
    Box box_;
};

/// Computes map(begin, end) for pieces of a long list in parallel tasks, and combines the results.
template <typename Map, typename Combine>
auto inPieces(Reference* begin, Reference* end, const Map& map, const Combine& combine) {
    constexpr std::ptrdiff_t PIECE = 8192;
    if (end - begin <= PIECE)
        return map(begin, end);
    Reference* const middle = begin + (end - begin) / 2;
    decltype(map(begin, end)) first, second;
#pragma omp task default(shared)
    first = inPieces(begin, middle, map, combine);
    second = inPieces(middle, end, map, combine);
#pragma omp taskwait
    return combine(first, second);
}

/// Swaps references until those for which isInFirst(reference) stand in front of the others.
/// @return where the others begin
template <typename IsInFirst>
Reference* moveToFront(Reference* begin, Reference* end, const IsInFirst& isInFirst) {
    Reference* middle = begin;
    // Without a branch: in which part a reference is cannot be predicted.
    for (Reference* next = begin; next < end; ++next) {
        const bool isFirst = isInFirst(*next);
        swap(*next, *middle);
        middle += isFirst ? 1 : 0;
    }
    return middle;
}

/// Two adjacent lists in two parts each become one such list: the second part of the one and the
/// first part of the other, which stand the wrong way round, change places.
/// @return where the second part begins
inline Reference* join(Reference* middle, Reference* otherBegin, Reference* otherMiddle) {
    const std::ptrdiff_t count = std::min(otherBegin - middle, otherMiddle - otherBegin);
    std::swap_ranges(middle, middle + count, otherMiddle - count);
    return middle + (otherMiddle - otherBegin);
}

}  // namespace bwfirt
