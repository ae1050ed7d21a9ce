// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

namespace bwfirt::binary {

/// Finds the wide tree of least cost that a binary tree contains, by the dynamic programming of
/// Ylitie, Karras and Laine: "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", HPG 2017, section 3.2. The cost is that of the surface area heuristic. All threads work
/// on it; the wide tree does not depend on their number.
///
/// A Layout says what the wide tree is like:
///   WIDTH                            the most children of a node
///   NODE_COST, LEAF_COST, UNIT_COST  of a ray that meets the box, relative to each other: to test
///                                    the boxes of a node, to begin with a leaf, and for each of
///                                    the leaf's units
///   leafUnits(node)                  what the triangles below a binary node take as a leaf, in any
///                                    unit; 0 where they do not fit in one
///   Extent                           what nodes and leaves take, a sum
///   nodeExtent(), leafExtent(units)  of one node, and of one leaf
template <typename Layout>
class Collapse {
  public:
    static constexpr std::size_t WIDTH = Layout::WIDTH;
    using Extent = typename Layout::Extent;

    Collapse(const BinaryTree& tree, const Layout& layout)
        : layout_(layout),
          tree_(tree),
          weights_(tree.nodes.size()),
          isOneWeighed_(tree.parents.size()),
          extents_(tree.nodes.size()) {
#pragma omp parallel
#pragma omp single
        descend(0, 0);
        measure();
    }

    /// Length of the longest way from the root of the binary tree to a leaf.
    int height() const {
        return weights_[0].height;
    }

    /// Of the wide tree.
    Extent extent() const {
        return extents_[0];
    }

    /// As many as a wide node has children.
    template <typename T>
    class Some {
      public:
        void add(const T& one) { items_[count_++] = one; }
        std::size_t size() const { return count_; }
        const T& operator[](std::size_t i) const { return items_[i]; }
        auto begin() { return items_.begin(); }
        auto end() { return items_.begin() + count_; }
        auto begin() const { return items_.begin(); }
        auto end() const { return items_.begin() + count_; }

      private:
        std::array<T, WIDTH> items_;
        std::size_t count_ = 0;
    };

    struct Child {
        std::uint32_t node;  ///< of the binary tree, of which all that is below it belongs to this
        bool isLeaf;
        Extent begin;  ///< of what stands before it: its parent, the leaves beside it, and so on
    };
    using Children = Some<Child>;

    /// Calls write(begin, children) for each wide node, from several threads. Behind a node stand
    /// its leaves, and then all that is below its first child that is a node, its second and so on.
    template <typename Write>
    void write(const Write& write) const {
        const auto writeNode = [&](const Part& part) {
            const Children children = childrenFrom(part);
            write(part.begin, children);
            Some<Part> parts;
            for (const Child& child : children)
                if (!child.isLeaf)
                    parts.add({child.node, child.begin});
            return parts;
        };
        KernelVector<Part> parts{{0, {}}};
        const std::size_t top = unfold(parts, writeNode);
#pragma omp parallel for schedule(dynamic)
        for (std::size_t i = top; i < parts.size(); ++i)
            forAllBelow(parts[i], writeNode);
    }

  private:
    /// Binary nodes at this depth and below it are left to the thread that has come to them.
    static constexpr int PARALLEL_DEPTH = 16;
    /// Wide nodes are measured and written one after the other from the root on, until there is
    /// room for so many threads below them.
    static constexpr std::size_t PARTS = 256;
    static constexpr float INFINITE_COST = std::numeric_limits<float>::infinity();

    struct Weight {
        /// costs[i] is the least cost of what is below a binary node, where it becomes at most
        /// i + 1 children of a wide node.
        std::array<float, WIDTH> costs;
        std::uint16_t height;    ///< of what is below it
        std::uint8_t leafUnits;  ///< that it takes as a leaf; 0 where it does not fit in one
        bool isLeaf;             ///< whether it is best made a leaf
    };

    using Nodes = Some<std::uint32_t>;

    /// A wide node, and where it is to be.
    struct Part {
        std::uint32_t node;  ///< of the binary tree
        Extent begin;
    };

    /// Weighs all that is below a node. No task waits for another, which would leave its thread
    /// idle where one child of a node has much more below it than the other.
    void descend(std::uint32_t index, int depth) {
        const BinaryNode& node = tree_.nodes[index];
        if (node.count > 0) {
            ascend(index);
            return;
        }
        if (depth < PARALLEL_DEPTH) {
#pragma omp task firstprivate(node, depth)
            descend(node.first, depth + 1);
        } else {
            descend(node.first, depth + 1);
        }
        descend(node.first + 1, depth + 1);
    }

    /// Weighs a leaf and then one node after the other on the way to the root, as far as both
    /// children have been weighed: the thread that weighs the second one goes on.
    void ascend(std::uint32_t index) {
        weigh(index);
        while (index != 0 && std::atomic_ref(isOneWeighed_[index / 2]).exchange(1) != 0) {
            index = tree_.parents[index / 2];
            weigh(index);
        }
    }

    void weigh(std::uint32_t index) {
        const BinaryNode& node = tree_.nodes[index];
        const float area = halfArea(node.bounds);
        Weight& weight = weights_[index];
        weight.costs.fill(INFINITE_COST);
        weight.leafUnits = 0;
        weight.height = 0;
        weight.isLeaf = false;
        if (node.count > 0) {
            weighAsLeaf(index, area);
            weight.costs.fill(weight.costs[0]);
            return;
        }

        const Weight &first = weights_[node.first], &second = weights_[node.first + 1];
        weight.height = static_cast<std::uint16_t>(1 + std::max(first.height, second.height));
        const auto &one = first.costs, &other = second.costs;
        for (std::size_t most = 2; most <= WIDTH; ++most)
            for (std::size_t share = 1; share < most; ++share)
                weight.costs[most - 1] =
                    std::min(weight.costs[most - 1], one[share - 1] + other[most - share - 1]);
        weight.costs[0] = weight.costs[WIDTH - 1] + area * Layout::NODE_COST;
        if (first.leafUnits > 0 && second.leafUnits > 0)
            weighAsLeaf(index, area);
        for (std::size_t i = 1; i < WIDTH; ++i)
            weight.costs[i] = std::min(weight.costs[i], weight.costs[i - 1]);
    }

    void weighAsLeaf(std::uint32_t index, float area) {
        Weight& weight = weights_[index];
        weight.leafUnits = layout_.leafUnits(index);
        if (weight.leafUnits == 0)
            return;
        const float cost = area * (Layout::LEAF_COST + Layout::UNIT_COST * weight.leafUnits);
        weight.isLeaf = cost <= weight.costs[0];
        weight.costs[0] = std::min(weight.costs[0], cost);
    }

    static float halfArea(const Bounds& bounds) {
        const V3d size = V3d(bounds.high) - V3d(bounds.low);
        return static_cast<float>(size.x * size.y + size.y * size.z + size.z * size.x);
    }

    /// How many of `most` children are best given to the first child of a binary node.
    std::size_t shareOfFirst(const BinaryNode& node, std::size_t most) const {
        const auto &one = weights_[node.first].costs, &other = weights_[node.first + 1].costs;
        std::size_t best = 1;
        for (std::size_t share = 2; share < most; ++share)
            if (one[share - 1] + other[most - share - 1] < one[best - 1] + other[most - best - 1])
                best = share;
        return best;
    }

    Nodes childrenOf(std::uint32_t index) const {
        Nodes children;
        if (weights_[index].isLeaf) {  // the root
            children.add(index);
            return children;
        }
        const BinaryNode& node = tree_.nodes[index];
        const std::size_t share = shareOfFirst(node, WIDTH);
        split(node.first, share, children);
        split(node.first + 1, WIDTH - share, children);
        return children;
    }

    void split(std::uint32_t index, std::size_t most, Nodes& children) const {
        const auto& costs = weights_[index].costs;
        while (most > 1 && costs[most - 2] == costs[most - 1])
            --most;
        if (most == 1) {
            children.add(index);
            return;
        }
        const BinaryNode& node = tree_.nodes[index];
        const std::size_t share = shareOfFirst(node, most);
        split(node.first, share, children);
        split(node.first + 1, most - share, children);
    }

    /// The children of a wide node, and where they are to be.
    Children childrenFrom(const Part& part) const {
        const Nodes nodes = childrenOf(part.node);
        std::array<Extent, WIDTH> begins;
        Extent next = part.begin;
        next += Layout::nodeExtent();
        for (const bool areLeaves : {true, false})
            for (std::size_t i = 0; i < nodes.size(); ++i)
                if (weights_[nodes[i]].isLeaf == areLeaves) {
                    begins[i] = next;
                    next += extentBelow(nodes[i]);
                }
        Children children;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            children.add({nodes[i], weights_[nodes[i]].isLeaf, begins[i]});
        return children;
    }

    Extent extentBelow(std::uint32_t node) const {
        const Weight& weight = weights_[node];
        return weight.isLeaf ? Layout::leafExtent(weight.leafUnits) : extents_[node];
    }

    void measure() {
        const auto wideChildrenOf = [&](std::uint32_t node) {
            Nodes wide;
            for (const std::uint32_t child : childrenOf(node))
                if (!weights_[child].isLeaf)
                    wide.add(child);
            return wide;
        };
        KernelVector<std::uint32_t> nodes{0};
        std::size_t top = unfold(nodes, wideChildrenOf);
#pragma omp parallel for schedule(dynamic)
        for (std::size_t i = top; i < nodes.size(); ++i)
            measureBelow(nodes[i]);
        while (top-- > 0)
            measure(nodes[top], childrenOf(nodes[top]));
    }

    void measureBelow(std::uint32_t index) {
        const Nodes children = childrenOf(index);
        for (const std::uint32_t child : children)
            if (!weights_[child].isLeaf)
                measureBelow(child);
        measure(index, children);
    }

    void measure(std::uint32_t index, const Nodes& children) {
        Extent extent = Layout::nodeExtent();
        for (const std::uint32_t child : children)
            extent += extentBelow(child);
        extents_[index] = extent;
    }

    /// Appends the children of one node after the other, until there is work for all threads.
    /// @return how many nodes have theirs behind them; what is below the others is yet to be
    /// visited
    template <typename T, typename ChildrenOf>
    static std::size_t unfold(KernelVector<T>& nodes, const ChildrenOf& childrenOf) {
        std::size_t top = 0;
        for (; top < nodes.size() && nodes.size() < PARTS; ++top)
            for (const T& child : childrenOf(nodes[top]))
                nodes.push_back(child);
        return top;
    }

    template <typename Visit>
    static void forAllBelow(const Part& part, const Visit& visit) {
        for (const Part& child : visit(part))
            forAllBelow(child, visit);
    }

    Layout layout_;
    const BinaryTree& tree_;
    UnsetVector<Weight> weights_;
    KernelVector<std::uint8_t> isOneWeighed_;  ///< of the nodes 2 i and 2 i + 1
    UnsetVector<Extent> extents_;              ///< of what a node becomes, with all below it
};

}  // namespace bwfirt::binary
