// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/WatertightRay.h"
#include "kernel/wide-bvh/LeafTest.h"
#include "kernel/wide-bvh/NodeTest.h"

#include <bit>
#include <limits>

namespace bwfirt::wide {

/// One ray on its way through the tree to the nearest hit, in steps of a node or a leaf.
class NearestQuery {
  public:
    using Question = Ray;
    using Answer = std::optional<Hit>;

    NearestQuery(const WideTree& tree, const Ray& ray)
        : tree_(tree), ray_(ray), constants_(ray.origin, ray.direction, tree.reach()) {}

    /// False where the ray is at its end.
    bool step() {
        if (Child::isLeaf(next_))
            visitLeaf();
        else
            visitNode();
        return chooseNext();
    }

    /// Has the memory fetched that the next step reads.
    void prefetch() const { tree_.prefetch(next_); }

    Answer answer() const {
        return isHit_ ? Answer({static_cast<float>(tNearest_), nearest_}) : std::nullopt;
    }

  private:
    void visitNode() {
        keysStack_[size_].keys = keys_;
        nodeStack_[size_] = node_;
        size_ += isAnyKeyLeft(keys_) ? 1 : 0;
        node_ = &tree_.node(next_);
        const NodeMeeting meeting = meet(*node_, constants_, tMax_);
        keys_ = keysOf(meeting.t, meeting.children);
    }

    void visitLeaf() {
        const Leaf leaf = tree_.leaf(next_);
        Mask possible = meet(leaf, constants_, tMax_).possible;
        for (; possible != 0; possible &= possible - 1)
            test(leaf, static_cast<std::size_t>(std::countr_zero(possible)));
    }

    void test(const Leaf& leaf, std::size_t triangle) {
        const WatertightRay exact(V3d(ray_.origin), V3d(ray_.direction));
        const std::optional<double> t = exact.intersect(leaf.triangle(triangle));
        if (!t || !(*t < tNearest_) || !(static_cast<float>(*t) > 0))
            return;
        tNearest_ = *t;
        tMax_ = static_cast<float>(*t);
        nearest_ = leaf.index(triangle);
        isHit_ = true;
    }

    /// Takes the nearest child of the last node that has any left. A key is less than the distance
    /// that it stands for by its lowest bits. While a leaf is tested, the child after it is
    /// fetched.
    bool chooseNext() {
        std::int32_t key = least(keys_);
        while (key > std::bit_cast<std::int32_t>(tMax_)) {
            if (size_ == 0)
                return false;
            keys_ = keysStack_[--size_].keys;
            node_ = nodeStack_[size_];
            key = least(keys_);
        }
        const int lane = laneOf(key);
        keys_ = without(keys_, lane);
        next_ = node_->children[static_cast<std::size_t>(lane)];
        if (Child::isLeaf(next_) && isAnyKeyLeft(keys_))
            tree_.prefetch(node_->children[static_cast<std::size_t>(laneOf(least(keys_)))]);
        return true;
    }

    const WideTree& tree_;
    Ray ray_;
    RayConstants constants_;
    std::uint32_t next_ = 0;
    float tMax_ = std::numeric_limits<float>::max();
    double tNearest_ = std::numeric_limits<float>::max();
    std::uint32_t nearest_ = 0;
    bool isHit_ = false;

    /// Children of a node that the ray meets and has not been to: of the last node, and of those
    /// above it.
    Ints keys_ = noKeys();
    const Node* node_ = nullptr;
    std::size_t size_ = 0;
    struct Keys {
        Ints keys;
    };
    std::array<Keys, WideTree::MOST_DEPTH + 1> keysStack_;
    std::array<const Node*, WideTree::MOST_DEPTH + 1> nodeStack_;
};

}  // namespace bwfirt::wide
