// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"
#include "kernel/bih/NodePairs.h"

#include <span>

namespace bwfirt {

/// A bounding interval hierarchy over triangles.
struct Tree {
    /// Most nodes with two children that hold triangles on the way from the root to a leaf.
    static constexpr int MAX_SPLITS = 96;

    Box bounds;
    Node root = Node::leaf(0, 0);
    KernelArray<NodePair> children;    ///< of the inner nodes
    KernelArray<std::uint32_t> order;  ///< triangles in the order of the leaves
};

/// The tree is the same for any number of threads, up to the places of the children.
Tree buildTree(std::span<const Triangle> triangles);

}  // namespace bwfirt
