// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "kernel/Triangle4.h"

#include <cassert>
#include <cstdint>
#include <span>

namespace bwfirt {

/// An axis-aligned box with corners in single precision, which hold coordinates of vertices
/// exactly.
struct Bounds {
    V3f low;
    V3f high;
};

/// A node in eight bytes. The first child of an inner node stands directly behind it.
class KdNode {
  public:
    /// What the 30 bits for a child's index can tell apart.
    static constexpr std::size_t MOST_NODES = std::size_t{1} << 30;

    static KdNode leaf(std::uint32_t first, std::uint32_t count) {
        KdNode node;
        node.first_ = first;
        node.bits_ = count << 2 | LEAF;
        return node;
    }

    static KdNode inner(int axis, float position) {
        KdNode node;
        node.position_ = position;
        node.bits_ = static_cast<std::uint32_t>(axis);
        return node;
    }

    void setSecondChild(std::uint32_t index) { bits_ = index << 2 | (bits_ & 3); }

    bool isLeaf() const { return (bits_ & 3) == LEAF; }
    int axis() const { return static_cast<int>(bits_ & 3); }
    float position() const { return position_; }
    std::uint32_t secondChild() const { return bits_ >> 2; }
    std::uint32_t first() const { return first_; }
    std::uint32_t count() const { return bits_ >> 2; }

  private:
    static constexpr std::uint32_t LEAF = 3;

    union {
        float position_;       ///< inner node: where the plane cuts the axis
        std::uint32_t first_;  ///< leaf: index of its first triangles
    };
    std::uint32_t bits_;  ///< axis or LEAF in the lower two, second child or count above
};
static_assert(sizeof(KdNode) == 8);

/// A tree over triangles. A leaf holds all triangles whose boxes meet its cell.
struct KdTree {
    /// Longest way from the root to a leaf: 8 + 1.3 * log2 of at most 2^32 triangles.
    static constexpr int MAX_DEPTH = 49;

    Bounds bounds;
    KernelVector<KdNode> nodes;  ///< the root first; none for a scene without area
    KernelVector<Triangle4> triangles;
};

KdTree buildKdTree(std::span<const Triangle> triangles, std::uint32_t leafSize);

}  // namespace bwfirt
