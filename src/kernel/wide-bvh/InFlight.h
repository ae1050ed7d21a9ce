// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/DropBeyond.h"
#include "kernel/wide-bvh/LeafHits.h"
#include "kernel/wide-bvh/NodeTest.h"
#include "kernel/wide-bvh/RayBatch.h"

#include <bit>

namespace bwfirt::wide {

/// Rays under way through the tree, each of which takes a step in turn, to a node or a leaf, while
/// the memory for the others' next steps is fetched.
///
/// What a processor guesses wrongly for one ray it loses for all of them. So a step to a node has
/// no branch: whatever children are met go to the ray's stack, and the top of it is where the ray
/// goes next. And all rays that are at a node take their steps before those that are at a leaf.
///
/// @tparam Query says what becomes of a node and of a leaf
template <typename Query>
class InFlight {
  protected:
    using Bits = RayBatch::Bits;

    /// A node on the way down leaves at most its other children on the stack; storeChosen writes
    /// beyond.
    static constexpr std::size_t STACK_SIZE = (WideTree::MOST_DEPTH + 1) * (WIDTH - 1) + WIDTH + 1;

    template <typename Question>
    InFlight(const WideTree& tree, std::span<const Question> questions)
        : tree_(tree), rays_(questions, tree.reach()) {}

    void run() {
        Bits underWay = rays_.canBeAsked(), atLeaf = 0;
        for (std::size_t ray = 0; ray < RayBatch::SIZE; ++ray) {
            next_[ray] = WideTree::ROOT;
            stacks_[ray][0] = tree_.end();
            sizes_[ray] = 1;
        }
        auto& query = static_cast<Query&>(*this);
        const auto goOn = [&](std::size_t ray) {
            const std::uint32_t next = stacks_[ray][--sizes_[ray]];
            tree_.prefetchAny(next);
            next_[ray] = next;
            const Bits isAtLeaf = Child::isLeaf(next) ? 1 : 0;
            atLeaf = (atLeaf & ~(Bits{1} << ray)) | isAtLeaf << ray;
            const Bits isAtEnd = next == tree_.end() ? 1 : 0;
            underWay &= ~(isAtEnd << ray);
        };
        while (underWay != 0) {
            // Those that come to a leaf in this turn leave its memory time until the next one.
            const Bits atLeafNow = underWay & atLeaf;
            for (Bits left = underWay & ~atLeaf; left != 0; left &= left - 1) {
                const auto ray = static_cast<std::size_t>(std::countr_zero(left));
                query.visit(tree_.node(next_[ray]), ray);
                goOn(ray);
            }
            for (Bits left = atLeafNow; left != 0; left &= left - 1) {
                const auto ray = static_cast<std::size_t>(std::countr_zero(left));
                const Bits isAnswered = query.visit(tree_.leaf(next_[ray]), ray) ? 1 : 0;
                goOn(ray);
                underWay &= ~(isAnswered << ray);
            }
        }
    }

    const WideTree& tree_;
    RayBatch rays_;
    std::array<std::uint32_t, RayBatch::SIZE> next_, sizes_;
    std::array<std::array<std::uint32_t, STACK_SIZE>, RayBatch::SIZE> stacks_;  ///< of children
};

/// Rays in flight to their nearest hits.
class NearestInFlight : InFlight<NearestInFlight> {
  public:
    NearestInFlight(const WideTree& tree, std::span<const Ray> rays)
        : InFlight(tree, rays), questions_(rays) {
        for (auto& enters : enters_)
            enters[0] = 0;
        run();
    }

    std::optional<Hit> answer(std::size_t ray) const { return nearest_[ray].hit(); }

  private:
    friend InFlight;

    /// The children that are met go to the stack in the order of the ray's octant.
    void visit(const Node& node, std::size_t ray) {
        const NodeSpans spans = spansOf(node, rays_[ray], nearest_[ray].tMax());
        const Ints order = shiftRight(load(node.order.data()), Node::shift(rays_.octant(ray)));
        const Floats enter = permute(spans.enter, order);
        const Mask met = isLessOrEqual(enter, permute(spans.leave, order));
        const std::uint32_t size = sizes_[ray];
        storeChosen(&stacks_[ray][size], met, permute(load(node.children.data()), order));
        storeChosen(&enters_[ray][size], met, enter);
        sizes_[ray] = size + static_cast<std::uint32_t>(std::popcount(met));
    }

    bool visit(const Leaf& leaf, std::size_t ray) {
        NearestHit& nearest = nearest_[ray];
        const Mask possible = meet(leaf, rays_[ray], nearest.tMax()).possible;
        if (nearest.test(questions_[ray], leaf, possible))
            sizes_[ray] =
                dropBeyond(nearest.tMax(), stacks_[ray].data(), enters_[ray].data(), sizes_[ray]);
        return false;
    }

    std::span<const Ray> questions_;
    std::array<NearestHit, RayBatch::SIZE> nearest_;
    std::array<std::array<float, STACK_SIZE>, RayBatch::SIZE> enters_;  ///< of children on stacks
};

/// Segments in flight to whatever blocks them.
class VisibilityInFlight : InFlight<VisibilityInFlight> {
  public:
    VisibilityInFlight(const WideTree& tree, std::span<const RTKernel::Segment> segments)
        : InFlight(tree, segments), questions_(segments) {
        run();
    }

    bool answer(std::size_t ray) const { return (blocked_ >> ray & 1) == 0; }

  private:
    friend InFlight;

    void visit(const Node& node, std::size_t ray) {
        const Mask met = meet(node, rays_[ray], 1).children;
        const std::uint32_t size = sizes_[ray];
        storeChosen(&stacks_[ray][size], met, load(node.children.data()));
        sizes_[ray] = size + static_cast<std::uint32_t>(std::popcount(met));
    }

    bool visit(const Leaf& leaf, std::size_t ray) {
        const Bits isBlocked = isBlockedBy(leaf, rays_[ray], questions_[ray]) ? 1 : 0;
        blocked_ |= isBlocked << ray;
        return isBlocked != 0;
    }

    std::span<const RTKernel::Segment> questions_;
    Bits blocked_ = 0;
};

}  // namespace bwfirt::wide
