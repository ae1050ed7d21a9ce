// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/WatertightRay.h"
#include "kernel/wide-bvh/LeafTest.h"
#include "kernel/wide-bvh/OpenChildren.h"
#include "kernel/wide-bvh/OpenNodes.h"

#include <bit>
#include <limits>
#include <type_traits>

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
        if (!Child::isLeaf(next_)) {
            const Node& node = tree_.node(next_);
            return open_.enter(tree_, node, meet(node, constants_, tMax_), tMax_, next_);
        }
        visitLeaf();
        return open_.take(tree_, tMax_, next_);
    }

    /// Has the memory fetched that the next step reads.
    void prefetch() const { tree_.prefetch(next_); }

    Answer answer() const {
        return isHit_ ? Answer({static_cast<float>(tNearest_), nearest_}) : std::nullopt;
    }

  private:
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

    const WideTree& tree_;
    Ray ray_;
    RayConstants constants_;
    std::uint32_t next_ = 0;
    float tMax_ = std::numeric_limits<float>::max();
    double tNearest_ = std::numeric_limits<float>::max();
    std::uint32_t nearest_ = 0;
    bool isHit_ = false;
    std::conditional_t<HAS_WIDE_REGISTERS, OpenNodes, OpenChildren> open_;
};

}  // namespace bwfirt::wide
