// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace bwfirt {

using Ints4 = std::experimental::rebind_simd_t<int, Floats4>;

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
        Reference* const middle = moveToFront(from, to, isInFirst);
        return Parts{from, middle, to};
    };
    return inPieces(begin, end, map,
                    [](const Parts& a, const Parts& b) {
                        return Parts{a.begin, join(a.middle, b.begin, b.middle), b.end};
                    })
        .middle;
}

}  // namespace bwfirt
