// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"
#include "kernel/KernelArray.h"
#include "kernel/qbvh/Node.h"

namespace bwfirt {

/// A tree over triangles.
struct Tree {
    /// Longest way from the root to a leaf.
    static constexpr int MAX_DEPTH = binary::BinaryTree::MAX_DEPTH;

    KernelArray<Node> nodes;           ///< the root first; none for a scene without area
    KernelArray<std::uint8_t> leaves;  ///< see Leaf
    double scale = 1;                  ///< from the scene's coordinates to those of the nodes
};

Tree buildTree(std::span<const Triangle> triangles);

}  // namespace bwfirt
