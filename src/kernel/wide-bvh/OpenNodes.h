// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/NodeTest.h"

#include <array>
#include <limits>

namespace bwfirt::wide {

/// The children that a ray has met and not been to, node by node: each node's are a vector of keys,
/// of which the least is taken. Nothing is sorted, and hardly anything depends on how many children
/// are met, so that there is little to be mispredicted. For wide registers.
class OpenNodes {
  public:
    /// Adds the children of a node, and takes the nearest of all.
    bool enter(const WideTree& tree, const Node& node, const NodeMeeting& meeting,
               std::uint32_t& next) {
        keysStack_[size_].keys = keys_;
        nodeStack_[size_] = node_;
        size_ += isAnyKeyLeft(keys_) ? 1 : 0;
        node_ = &node;
        keys_ = keysOf(meeting.t, meeting.children);
        return take(tree, next);
    }

    /// Takes the nearest child of the last node that has any left. A key is less than the distance
    /// that it stands for by its lowest bits. While a leaf is tested, the child after it is
    /// fetched.
    /// @return false where there is none left
    bool take(const WideTree& tree, std::uint32_t& next) {
        std::int32_t key = least(keys_);
        while (isBeyond(key, tMax_)) {
            if (size_ == 0)
                return false;
            keys_ = keysStack_[--size_].keys;
            node_ = nodeStack_[size_];
            key = least(keys_);
        }
        const std::size_t lane = laneOf(key);
        keys_ = without(keys_, lane);
        next = node_->children[lane];
        if (Child::isLeaf(next) && isAnyKeyLeft(keys_))
            tree.prefetch(node_->children[laneOf(least(keys_))]);
        return true;
    }

    /// After a hit: what lies beyond it falls away when it is taken.
    void dropBeyond(float tMax) { tMax_ = tMax; }

  private:
    float tMax_ = std::numeric_limits<float>::max();
    Keys keys_ = noKeys();  ///< of the last node
    const Node* node_ = nullptr;
    /// Of those above it.
    std::size_t size_ = 0;
    struct KeysOfNode {
        Keys keys;
    };
    std::array<KeysOfNode, WideTree::MOST_DEPTH + 1> keysStack_;
    std::array<const Node*, WideTree::MOST_DEPTH + 1> nodeStack_;
};

}  // namespace bwfirt::wide
