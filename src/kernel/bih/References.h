// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Triangle.h"

#include <experimental/simd>

#include <algorithm>
#include <bit>
#include <cstdint>
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

    int longestAxis() const {
        const Floats4 half = 0.5F * high - 0.5F * low;
        const int axis = half[0] > half[1] ? 0 : 1;
        return half[axis] > half[2] ? axis : 2;
    }
};

/// A triangle in a list to be sorted: its box, with the index in the fourth number.
class Reference {
  public:
    /// The box is larger than the triangle on all sides by a step of single precision and by more
    /// than the rounding errors of WatertightRay: what that finds just beside a triangle must not
    /// be lost. It is empty for a triangle that cannot be hit.
    Reference(const Triangle& triangle, std::uint32_t index) {
        if (hasArea(triangle)) {
            for (const V3f& vertex : triangle.vertices) {
                const Floats4 corner([&](int axis) { return axis < 3 ? vertex[axis] : 0; });
                box_.extend({corner, corner});
            }
            constexpr float STEP = std::numeric_limits<float>::epsilon();
            const float margin = 1e-12F * hmax(box_.high - box_.low);
            box_.low -= STEP * abs(box_.low) + margin;
            box_.high += STEP * abs(box_.high) + margin;
        }
        box_.low[3] = std::bit_cast<float>(index);
    }

    const Box& box() const { return box_; }
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

/// Longer lists are worth a task of their own.
constexpr std::ptrdiff_t TASK_SIZE = 4096;

/// Computes map(begin, end) for pieces of a long list in parallel, and combines the results.
template <typename Map, typename Combine>
auto inPieces(Reference* begin, Reference* end, const Map& map, const Combine& combine) {
    if (end - begin <= 4 * TASK_SIZE)
        return map(begin, end);
    Reference* const middle = begin + (end - begin) / 2;
    decltype(map(begin, end)) first, second;
#pragma omp task default(shared)
    first = inPieces(begin, middle, map, combine);
    second = inPieces(middle, end, map, combine);
#pragma omp taskwait
    return combine(first, second);
}

inline Box boundsOf(const Reference* begin, const Reference* end) {
    Box bounds;
    for (; begin < end; ++begin)
        bounds.extend(begin->box());
    // The bits of an index are a tiny number, with which processors compute slowly.
    bounds.low[3] = bounds.high[3] = 0;
    return bounds;
}

/// A list in two parts, with their bounds.
struct Parts {
    Reference* begin;
    Reference* middle;
    Reference* end;
    Box firstBounds;
    Box secondBounds;
};

/// Swaps references until those for which isInFirst(reference) stand in front of the others.
template <typename IsInFirst>
Parts partition(Reference* begin, Reference* end, const IsInFirst& isInFirst) {
    const auto map = [isInFirst](Reference* from, Reference* to) {
        Reference* middle = from;
        // Without a branch: in which part a reference is cannot be predicted.
        for (Reference* next = from; next < to; ++next) {
            const bool isFirst = isInFirst(*next);
            swap(*next, *middle);
            middle += isFirst ? 1 : 0;
        }
        return Parts{from, middle, to, boundsOf(from, middle), boundsOf(middle, to)};
    };
    return inPieces(begin, end, map, [](Parts a, const Parts& b) {
        // a's second part and b's first part stand the wrong way round.
        const std::ptrdiff_t count = std::min(a.end - a.middle, b.middle - b.begin);
        std::swap_ranges(a.middle, a.middle + count, b.middle - count);
        a.middle += b.middle - b.begin;
        a.end = b.end;
        a.firstBounds.extend(b.firstBounds);
        a.secondBounds.extend(b.secondBounds);
        return a;
    });
}

}  // namespace bwfirt
