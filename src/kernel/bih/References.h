// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Reference.h"

namespace bwfirt {

/// Longer lists are worth a task of their own.
constexpr std::ptrdiff_t TASK_SIZE = 4096;

inline Box boundsOf(const Reference* begin, const Reference* end) {
    Box bounds;
    for (; begin < end; ++begin)
        bounds.extend(begin->boxWithIndex());
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
        Reference* const middle = moveToFront(from, to, isInFirst);
        return Parts{from, middle, to, boundsOf(from, middle), boundsOf(middle, to)};
    };
    return inPieces(begin, end, map, [](Parts a, const Parts& b) {
        a.middle = join(a.middle, b.begin, b.middle);
        a.end = b.end;
        a.firstBounds.extend(b.firstBounds);
        a.secondBounds.extend(b.secondBounds);
        return a;
    });
}

}  // namespace bwfirt
