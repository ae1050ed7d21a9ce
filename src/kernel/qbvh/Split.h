// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace bwfirt {

/// A triangle while the tree is built: its box.
struct Reference {
    V3f low;
    V3f high;
    std::uint32_t triangle;

    Box box() const { return {toFloats4(low), toFloats4(high)}; }
};

/// References that stand side by side, and what has to be known to split them.
struct Group {
    std::span<Reference> references;
    Box bounds;
    Box centres;  ///< of the centres of the boxes, times two

    void extend(const Reference& reference) {
        const Box box = reference.box();
        bounds.extend(box);
        const Floats4 centre = box.low + box.high;
        centres.extend({centre, centre});
    }
    std::size_t size() const { return references.size(); }
};

/// Bounds of the group, found by all threads where it is large.
Group groupOf(std::span<Reference> references);

/// Two parts of a group.
struct Parts {
    Group first;
    Group second;
};

/// Reorders the references such that those of each part stand together.
/// The cut is the one of least cost by the surface area heuristic among equidistant planes, or
/// nothing where all centres are the same.
std::optional<Parts> splitBySah(const Group& group);

/// Halves the references as they stand, where there are many at a whole number of full leaves, so
/// that the parts need no more leaves than the group.
Parts halve(const Group& group);

}  // namespace bwfirt
