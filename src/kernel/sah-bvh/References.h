// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/sah-bvh/Box.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace bwfirt {

using Ints4 = std::experimental::rebind_simd_t<int, Floats4>;

/// The box of a triangle, with its index in the fourth number.
class Reference {
  public:
    Reference(const Triangle& triangle, std::uint32_t index)
        : box_(hasArea(triangle) ? boxOf(triangle) : Box()) {
        box_.low[3] = std::bit_cast<float>(index);
    }
    std::uint32_t triangle() const { return std::bit_cast<std::uint32_t>(float(box_.low[3])); }

    Box box() const {
        // The bits of an index are a tiny number, with which processors compute slowly.
        Box box = box_;
        box.low = Floats4([&](auto i) { return i < 3 ? box_.low[i] : 0.0F; });
        return box;
    }

    /// By vectors, as everything else reads and writes references: what has just been written in
    /// another size has to reach the cache before it can be read.
    friend void swap(Reference& a, Reference& b) {
        std::swap(a.box_.low, b.box_.low);
        std::swap(a.box_.high, b.box_.high);
    }

    float centre(int axis) const { return 0.5F * box_.low[axis] + 0.5F * box_.high[axis]; }

  private:
    Box box_;
};

/// Adjacent references, which become a subtree.
struct Range {
    Reference* begin;
    Reference* end;
    Box bounds;   ///< of the triangles
    Box centres;  ///< of the centres of their boxes

    std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// Ranges longer than this are worth a task of their own.
constexpr std::ptrdiff_t TASK_SIZE = 2048;

/// Computes map(begin, end) for pieces of a long range in parallel, and combines the results.
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

inline Range rangeOf(Reference* begin, Reference* end) {
    const auto map = [](Reference* from, Reference* to) {
        Range range{from, to, {}, {}};
        for (const Reference* reference = from; reference < to; ++reference) {
            const Box box = reference->box();
            range.bounds.extend(box);
            range.centres.extend({box.centre(), box.centre()});
        }
        return range;
    };
    return inPieces(begin, end, map, [](Range first, const Range& second) {
        first.end = second.end;
        first.bounds.extend(second.bounds);
        first.centres.extend(second.centres);
        return first;
    });
}

/// Moves the references that are in the first part to the front. @return where the second begins
template <typename IsInFirst>
Reference* partition(Reference* begin, Reference* end, const IsInFirst& isInFirst) {
    struct Parts {
        Reference *begin, *middle, *end;
    };
    const auto map = [&](Reference* from, Reference* to) {
        Reference* middle = from;
        // Without a branch: in which part a reference is cannot be predicted.
        for (Reference* next = from; next < to; ++next) {
            const bool isFirst = isInFirst(*next);
            swap(*next, *middle);
            middle += isFirst ? 1 : 0;
        }
        return Parts{from, middle, to};
    };
    return inPieces(begin, end, map,
                    [](const Parts& a, const Parts& b) {
                        // a's second part and b's first part stand the wrong way round.
                        const std::ptrdiff_t count = std::min(a.end - a.middle, b.middle - b.begin);
                        std::swap_ranges(a.middle, a.middle + count, b.middle - count);
                        return Parts{a.begin, a.middle + (b.middle - b.begin), b.end};
                    })
        .middle;
}

}  // namespace bwfirt
