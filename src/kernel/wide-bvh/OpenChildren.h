// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/DropBeyond.h"
#include "kernel/wide-bvh/NodeTest.h"

#include <array>
#include <bit>

namespace bwfirt::wide {

/// The children that a ray has met and not been to, the nearest of each node on top. Most nodes
/// have one or two that are met: each of these cases has code of its own. For narrow registers,
/// where keys would take longer than the branches.
class OpenChildren {
  public:
    /// Takes the nearest child of a node, and leaves the others for later.
    /// @return false where there is none, nor any left
    bool enter(const WideTree& tree, const Node& node, const NodeMeeting& meeting,
               std::uint32_t& next) {
        const Mask children = meeting.children;
        if (children == 0)
            return take(tree, next);
        const auto first = static_cast<std::size_t>(std::countr_zero(children));
        const Mask others = children & (children - 1);
        if (others == 0) {
            next = node.children[first];
            return true;
        }
        std::array<float, WIDTH> t;
        store(t.data(), meeting.t);
        const auto second = static_cast<std::size_t>(std::countr_zero(others));
        if ((others & (others - 1)) == 0) {
            const bool isInOrder = t[first] < t[second];
            const std::uint32_t one = node.children[first], other = node.children[second];
            tree.prefetch(one);
            tree.prefetch(other);
            next = isInOrder ? one : other;
            children_[size_] = isInOrder ? other : one;
            enters_[size_++] = std::max(t[first], t[second]);
            return true;
        }
        Keys keys = keysOf(meeting.t, children);
        std::size_t lane = laneOf(least(keys));
        next = node.children[lane];
        const auto count = static_cast<std::uint32_t>(std::popcount(others));
        for (std::uint32_t i = count; i-- > 0;) {
            keys = without(keys, lane);
            lane = laneOf(least(keys));
            tree.prefetch(node.children[lane]);
            children_[size_ + i] = node.children[lane];
            enters_[size_ + i] = t[lane];
        }
        size_ += count;
        return true;
    }

    /// @return false where there is none left
    bool take(const WideTree&, std::uint32_t& next) {
        if (size_ == 0)
            return false;
        next = children_[--size_];
        return true;
    }

    /// After a hit.
    void dropBeyond(float tMax) {
        size_ = wide::dropBeyond(tMax, children_.data(), enters_.data(), size_);
    }

  private:
    static constexpr std::size_t MOST = (WideTree::MOST_DEPTH + 1) * (WIDTH - 1) + WIDTH;

    std::uint32_t size_ = 0;
    std::array<std::uint32_t, MOST> children_;
    std::array<float, MOST> enters_;  ///< where the ray enters their boxes
};

}  // namespace bwfirt::wide
