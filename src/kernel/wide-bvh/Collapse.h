// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/BinaryTree.h"
#include "kernel/wide-bvh/WideTree.h"

namespace bwfirt::wide {

/// Finds the wide tree of least cost that a binary tree contains, by the dynamic programming of
/// Ylitie, Karras and Laine: "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", HPG 2017, section 3.2. The cost is that of the surface area heuristic.
class Collapse {
  public:
    Collapse(std::span<const Triangle> triangles, const BinaryTree& tree);

    /// Length of the longest way from the root of the binary tree to a leaf.
    int height() const { return weights_[0].height; }

    /// Lines of memory that the wide tree takes.
    std::size_t size() const { return sizes_[0]; }

    /// Writes the tree to `lines`, all of it.
    void write(Line* lines) const;

  private:
    /// Of a ray that meets the box, relative to each other: to test the boxes of a node, to begin
    /// with a leaf, and to fetch each of its lines.
    static constexpr float NODE_COST = 1, LEAF_COST = 1, LINE_COST = 0.15F;

    /// Binary nodes at this depth and below it are left to the thread that has come to them.
    static constexpr int PARALLEL_DEPTH = 16;
    /// Wide nodes are measured and written one after the other from the root on, until there is
    /// room for so many threads below them.
    static constexpr std::size_t PARTS = 256;

    struct Weight {
        /// costs[i] is the least cost of what is below a binary node, where it becomes at most
        /// i + 1 children of a wide node.
        std::array<float, WIDTH> costs;
        std::uint16_t height;    ///< of what is below it
        std::uint8_t leafLines;  ///< that it takes as a leaf; 0 where it does not fit in one
        bool isLeaf;             ///< whether it is best made a leaf
    };

    /// As many as a wide node has children.
    template <typename T>
    class Some {
      public:
        void add(const T& one) { items_[count_++] = one; }
        std::size_t size() const { return count_; }
        const T& operator[](std::size_t i) const { return items_[i]; }
        auto begin() const { return items_.begin(); }
        auto end() const { return items_.begin() + count_; }

      private:
        std::array<T, WIDTH> items_;
        std::size_t count_ = 0;
    };
    using Children = Some<std::uint32_t>;  ///< of a wide node, as nodes of the binary tree

    /// A wide node that is to be written.
    struct Part {
        std::uint32_t node;  ///< of the binary tree
        std::size_t line;    ///< where it is to be
    };

    void descend(std::uint32_t node, int depth);
    void ascend(std::uint32_t leaf);
    void weigh(std::uint32_t node);
    void weighAsLeaf(std::uint32_t node, float area);

    Children childrenOf(std::uint32_t node) const;
    void split(std::uint32_t node, std::size_t most, Children& children) const;
    /// Those of a node's children that are nodes themselves.
    Children wideOf(const Children& children) const;
    /// How many of `most` children are best given to the first child of a binary node.
    std::size_t shareOfFirst(const BinaryNode& node, std::size_t most) const;

    /// Appends the children of one node after the other, until there is work for all threads.
    /// @return how many nodes have theirs behind them; what is below the others is yet to be
    /// visited
    template <typename T, typename ChildrenOf>
    static std::size_t unfold(KernelVector<T>& nodes, const ChildrenOf& childrenOf);

    void measure();
    void measureBelow(std::uint32_t node);
    void measure(std::uint32_t node, const Children& children);
    /// @return those of its children that are wide nodes
    Some<Part> write(const Part& part, Line* lines) const;
    void writeBelow(const Part& part, Line* lines) const;

    std::span<const Triangle> triangles_;
    const BinaryTree& tree_;
    UnsetVector<Weight> weights_;
    KernelVector<std::uint8_t> isOneWeighed_;  ///< of the nodes 2 i and 2 i + 1
    UnsetVector<std::size_t> sizes_;           ///< lines that a node becomes, with all below it
};

}  // namespace bwfirt::wide
