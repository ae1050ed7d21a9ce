// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/LeafHits.h"
#include "kernel/wide-bvh/NodeTest.h"

#include <bit>

namespace bwfirt::wide {

/// One segment on its way through the tree to whatever blocks it. Any order will do, and so the
/// boxes of two nodes are tested at a time: one does not have to wait for the other.
class VisibilityQuery {
  public:
    VisibilityQuery(const WideTree& tree, const RTKernel::Segment& segment)
        : tree_(tree),
          segment_(segment),
          constants_(segment.x, segment.y - segment.x, tree.reach()) {
        nodes_[0] = WideTree::ROOT;
    }

    bool answer() {
        if (!constants_.canBeAsked)
            return true;
        while (leafCount_ > 0 || nodeCount_ > 0) {
            if (leafCount_ == 0)
                visitNodes();
            else if (isBlockedBy(tree_.leaf(leaves_[--leafCount_]), constants_, segment_))
                return false;
        }
        return true;
    }

  private:
    static constexpr std::size_t AT_A_TIME = 2;

    void visitNodes() {
        const Node& one = tree_.node(nodes_[--nodeCount_]);
        const bool areTwo = nodeCount_ > 0;
        const Node& two = areTwo ? tree_.node(nodes_[--nodeCount_]) : one;
        const Mask ofOne = meet(one, constants_, 1).children;
        const Mask ofTwo = areTwo ? meet(two, constants_, 1).children : 0;
        push(two, ofTwo);
        push(one, ofOne);
        if (leafCount_ > 1)
            tree_.prefetch(leaves_[leafCount_ - 2]);
        if (leafCount_ > 0 && nodeCount_ > 0)
            tree_.prefetch(nodes_[nodeCount_ - 1]);
    }

    void push(const Node& node, Mask children) {
        const Mask leaves = topBits(node.children.data());
        append(nodes_.data(), nodeCount_, children & ~leaves, node);
        append(leaves_.data(), leafCount_, children & leaves, node);
    }

    static void append(std::uint32_t* stack, std::size_t& count, Mask chosen, const Node& node) {
        storeChosen(stack + count, chosen, load(node.children.data()));
        count += static_cast<std::size_t>(std::popcount(chosen));
    }

    const WideTree& tree_;
    RTKernel::Segment segment_;
    RayConstants constants_;
    std::size_t nodeCount_ = 1, leafCount_ = 0;
    /// A node on the way down leaves at most its other children there; storeChosen writes beyond.
    std::array<std::uint32_t, (WideTree::MOST_DEPTH + 1) * AT_A_TIME * WIDTH> nodes_;
    std::array<std::uint32_t, (AT_A_TIME + 1) * WIDTH> leaves_;
};

}  // namespace bwfirt::wide
