// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/Reference.h"

#include <array>
#include <numeric>
#include <span>

namespace bwfirt::wide {

/// References in a row, and what a split has to know of them.
struct Group {
    Box box = Box::empty();
    Box halfCentres = Box::empty();  ///< around Reference::halfCentre()
    std::size_t size = 0;

    void add(const Reference& reference) {
        box.extend(reference.box());
        halfCentres.extend(reference.halfCentre());
        ++size;
    }
    void add(const Group& other) {
        box.extend(other.box);
        halfCentres.extend(other.halfCentres);
        size += other.size;
    }
};

/// The references below a split stand in front, those above behind them.
struct Partition {
    Group below;
    Group above;
};

enum class Side { BELOW, ABOVE, BOTH };

/// Divides references in place. Those on both sides are cut, and the parts above stored at `tail`.
/// @param sideOf (reference) -> Side
/// @param cutOf (reference) -> Parts
template <typename SideOf, typename CutOf>
Partition partition(std::span<Reference> references, Reference* tail, const SideOf& sideOf,
                    const CutOf& cutOf) {
    std::array<Group, 2> groups;
    Reference* firstAbove = references.data();
    for (Reference& place : references) {
        Reference reference = place;
        Side side = sideOf(reference);
        if (side == Side::BOTH) [[unlikely]] {
            const Parts parts = cutOf(reference);
            reference = parts.below;
            *tail++ = parts.above;
            groups[1].add(parts.above);
            side = Side::BELOW;
        }
        // Without a branch, which could not be predicted.
        groups[side == Side::BELOW ? 0 : 1].add(reference);
        place = *firstAbove;
        *firstAbove = reference;
        firstAbove += side == Side::BELOW ? 1 : 0;
    }
    return {groups[0], groups[1]};
}

/// The pieces in which many references are worked on in parallel. There are equally many for any
/// number of threads, so that the outcome is the same.
class Pieces {
  public:
    static constexpr std::size_t COUNT = 64;

    explicit Pieces(std::size_t size) : size_(size) {}
    std::size_t begin(std::size_t piece) const { return size_ * piece / COUNT; }
    std::size_t end(std::size_t piece) const { return begin(piece + 1); }

  private:
    std::size_t size_;
};

/// Exchanges the references above that stand before `middle` for those below behind it.
/// @param belowOf how many of each piece, in front of the others, are below
void exchange(std::span<Reference> references,
              const std::array<std::size_t, Pieces::COUNT>& belowOf, std::size_t middle);

/// The same as partition(), in tasks: divides each piece, and then exchanges what is on the wrong
/// side.
/// @param mayCut whether any reference may be on both sides
template <typename SideOf, typename CutOf>
Partition partitionInTasks(std::span<Reference> references, Reference* tail, const SideOf& sideOf,
                           const CutOf& cutOf, bool mayCut) {
    const Pieces pieces(references.size());
    const auto piece = [&](std::size_t i) {
        return references.subspan(pieces.begin(i), pieces.end(i) - pieces.begin(i));
    };
    std::array<std::size_t, Pieces::COUNT + 1> cuts{};  // in the pieces before
    if (mayCut) {
#pragma omp taskloop grainsize(1) default(shared)
        for (std::size_t i = 0; i < Pieces::COUNT; ++i)
            for (const Reference& reference : piece(i))
                cuts[i + 1] += sideOf(reference) == Side::BOTH ? 1 : 0;
        std::partial_sum(cuts.begin(), cuts.end(), cuts.begin());
    }

    std::array<Partition, Pieces::COUNT> parts;
#pragma omp taskloop grainsize(1) default(shared)
    for (std::size_t i = 0; i < Pieces::COUNT; ++i)
        parts[i] = partition(piece(i), tail + cuts[i], sideOf, cutOf);

    Partition all;
    std::array<std::size_t, Pieces::COUNT> belowOf;
    for (std::size_t i = 0; i < Pieces::COUNT; ++i) {
        all.below.add(parts[i].below);
        all.above.add(parts[i].above);
        belowOf[i] = parts[i].below.size;
    }
    exchange(references, belowOf, all.below.size);
    return all;
}

}  // namespace bwfirt::wide
