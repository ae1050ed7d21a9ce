// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"
#include "kernel/wide-bvh/WideTree.h"

namespace bwfirt::wide {

using namespace binary;

/// Triangles that are to become a leaf, and the vertices that they share.
class LeafContent {
  public:
    /// False where the triangles below the node do not fit in a leaf.
    bool collect(std::span<const Triangle> triangles, const BinaryTree& tree, std::uint32_t node);

    std::size_t bytes() const { return Leaf::bytes(triangleCount_, vertexCount_); }
    void write(Line* target) const;

  private:
    bool add(const Triangle& triangle, std::uint32_t index);
    /// Which vertex this one is; Leaf::MOST where there is no room for it.
    std::uint8_t vertexOf(const V3f& point);

    std::size_t triangleCount_, vertexCount_;
    std::array<V3f, Leaf::MOST> vertices_;
    std::array<std::uint32_t, Leaf::MOST> indices_;
    std::array<std::array<std::uint8_t, Leaf::MOST>, 3> corners_;  ///< by corner and triangle
};

}  // namespace bwfirt::wide
