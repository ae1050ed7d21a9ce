// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/LeafHits.h"
#include "kernel/wide-bvh/OpenChildren.h"
#include "kernel/wide-bvh/OpenNodes.h"

#include <type_traits>

namespace bwfirt::wide {

/// One ray on its way through the tree to the nearest hit.
class NearestQuery {
  public:
    NearestQuery(const WideTree& tree, const Ray& ray)
        : tree_(tree), ray_(ray), constants_(ray.origin, ray.direction, tree.reach()) {}

    std::optional<Hit> answer() {
        if (!constants_.canBeAsked)
            return std::nullopt;
        while (step()) {
        }
        return nearest_.hit();
    }

  private:
    /// To a node or a leaf. False where the ray is at its end.
    bool step() {
        if (!Child::isLeaf(next_)) {
            const Node& node = tree_.node(next_);
            __builtin_prefetch(&node.children);  // else not asked for before the boxes are tested
            return open_.enter(tree_, node, meet(node, constants_, nearest_.tMax()), next_);
        }
        const Leaf leaf = tree_.leaf(next_);
        if (nearest_.test(ray_, leaf, meet(leaf, constants_, nearest_.tMax()).possible))
            open_.dropBeyond(nearest_.tMax());
        return open_.take(tree_, next_);
    }

    const WideTree& tree_;
    Ray ray_;
    RayConstants constants_;
    std::uint32_t next_ = WideTree::ROOT;
    NearestHit nearest_;
    std::conditional_t<HAS_WIDE_REGISTERS, OpenNodes, OpenChildren> open_;
};

}  // namespace bwfirt::wide
