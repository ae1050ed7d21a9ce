// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Reference.h"

namespace bwfirt {

using Ints4 = std::experimental::rebind_simd_t<int, Floats4>;

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
