// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/qbvh/Tree.h"

#include "kernel/Collapse.h"
#include "kernel/Reinsertion.h"
#include "kernel/qbvh/Leaf.h"
#include "kernel/qbvh/Split.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bwfirt {

namespace {

using binary::BinaryNode;
using binary::BinaryTree;

/// Makes the binary tree. Each leaf has as many triangles as fit in one leaf of the wide tree, or
/// less where it is large: then it may be worth while to test boxes within it.
class BinaryTreeBuilder {
  public:
    explicit BinaryTreeBuilder(std::span<const Triangle> triangles) : triangles_(triangles) {}

    BinaryTree build() {
        collectReferences();
        if (count_ == 0)
            return {};
        if (count_ > LeafAddress::MOST_ADDRESSES)
            throw std::length_error("more triangles than a leaf can refer to");
        const std::size_t leaves = std::max(leavesNeeded(count_), count_ / TRIANGLES_PER_LEAF);
        tree_.nodes.resize(2 * leaves);
        tree_.parents.resize(leaves);
        const Group root = groupOf({references_.get(), count_});
        rootArea_ = root.bounds.halfArea();
#pragma omp parallel
#pragma omp single
        build({0, root, 1, leaves, 0});
        tree_.references.resize(count_);
#pragma omp parallel for
        for (std::size_t i = 0; i < count_; ++i)
            tree_.references[i] = references_[i].triangle;
        return std::move(tree_);
    }

  private:
    /// Groups of fewer references are built by one thread.
    static constexpr std::size_t TASK_SIZE = 1 << 10;
    /// Of all leaves, at least on average.
    static constexpr std::size_t TRIANGLES_PER_LEAF = 3;

    /// A node that is to be built.
    struct Task {
        std::uint32_t node;
        Group group;
        std::size_t slot;  ///< its children are the nodes 2 slot and 2 slot + 1, and what is below
                           ///< them has the slots behind
        std::size_t leaves;  ///< bound on their number
        int depth;
    };

    void collectReferences() {
        constexpr std::size_t PIECE = 1 << 14;
        const std::size_t pieces = (triangles_.size() + PIECE - 1) / PIECE;
        const auto end = [&](std::size_t i) {
            return std::min((i + 1) * PIECE, triangles_.size());
        };
        std::vector<std::size_t> first(pieces + 1, 0);
#pragma omp parallel for
        for (std::size_t piece = 0; piece < pieces; ++piece)
            for (std::size_t i = piece * PIECE; i < end(piece); ++i)
                first[piece + 1] += hasArea(triangles_[i]) ? 1 : 0;
        for (std::size_t piece = 0; piece < pieces; ++piece)
            first[piece + 1] += first[piece];
        count_ = first[pieces];
        references_ = makeKernelArray<Reference>(count_);
#pragma omp parallel for
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            Reference* next = &references_[first[piece]];
            for (std::size_t i = piece * PIECE; i < end(piece); ++i)
                if (hasArea(triangles_[i]))
                    *next++ = referenceTo(static_cast<std::uint32_t>(i));
        }
    }

    Reference referenceTo(std::uint32_t index) const {
        const auto& [a, b, c] = triangles_[index].vertices;
        Reference reference{a, a, index};
        for (int axis = 0; axis < 3; ++axis) {
            reference.low[axis] = std::min({a[axis], b[axis], c[axis]});
            reference.high[axis] = std::max({a[axis], b[axis], c[axis]});
        }
        return reference;
    }

    void build(const Task& task) {
        const Group& group = task.group;
        BinaryNode& node = tree_.nodes[task.node];
        node.bounds = {toV3f(group.bounds.low), toV3f(group.bounds.high)};
        if (isLeaf(task)) {
            node.first = static_cast<std::uint32_t>(group.references.data() - references_.get());
            node.count = static_cast<std::uint32_t>(group.size());
            return;
        }
        const Parts parts = split(task);
        const std::size_t one = leavesNeeded(parts.first.size());
        const std::size_t other = leavesNeeded(parts.second.size());
        const std::size_t spare = task.leaves - one - other;
        const std::size_t leaves = one + spare * parts.first.size() / group.size();
        node.first = static_cast<std::uint32_t>(2 * task.slot);
        node.count = 0;
        tree_.parents[task.slot] = task.node;
        const int depth = task.depth + 1;
        const Task first{node.first, parts.first, task.slot + 1, leaves, depth};
        const Task second{node.first + 1, parts.second, task.slot + leaves, task.leaves - leaves,
                          depth};
#pragma omp task default(none) firstprivate(first) if (first.group.size() > TASK_SIZE)
        build(first);
        build(second);
    }

    bool isLeaf(const Task& task) const {
        const Group& group = task.group;
        return group.size() == 1 ||
               (group.size() <= LeafAddress::MOST_TRIANGLES &&
                (task.leaves == 1 || group.bounds.halfArea() < binary::MUCH_AREA * rootArea_));
    }

    /// How many leaves so many triangles take at least.
    static std::size_t leavesNeeded(std::size_t count) {
        constexpr std::size_t MOST = LeafAddress::MOST_TRIANGLES;
        return (count + MOST - 1) / MOST;
    }

    static Parts split(const Task& task) {
        if (task.depth < MAX_SAH_DEPTH) {
            const std::optional<Parts> parts = splitBySah(task.group);
            if (parts && leavesNeeded(parts->first.size()) + leavesNeeded(parts->second.size()) <=
                             task.leaves)
                return *parts;
        }
        return halve(task.group);
    }

    static constexpr int MAX_SAH_DEPTH = BinaryTree::MAX_DEPTH - 32;

    std::span<const Triangle> triangles_;
    KernelArray<Reference> references_;
    std::size_t count_ = 0;
    double rootArea_ = 0;
    BinaryTree tree_;
};

/// What nodes and leaves take.
struct Extent {
    std::uint32_t nodes = 0;
    std::uint32_t triangles = 0;

    Extent& operator+=(const Extent& other) {
        nodes += other.nodes;
        triangles += other.triangles;
        return *this;
    }
};

/// Leaves are counted in triangles.
struct Layout {
    static constexpr std::size_t WIDTH = Node::WIDTH;
    static constexpr float NODE_COST = 1, LEAF_COST = 3, UNIT_COST = 0;
    using Extent = bwfirt::Extent;

    const BinaryTree& tree;

    std::uint8_t leafUnits(std::uint32_t node) const {
        std::uint8_t count = 0;
        const auto fits = [&](std::uint32_t) { return ++count <= LeafAddress::MOST_TRIANGLES; };
        return tree.allBelow(node, fits) ? count : 0;
    }
    static Extent nodeExtent() { return {1, 0}; }
    static Extent leafExtent(std::uint8_t units) { return {0, units}; }
};

class Builder {
  public:
    Builder(std::span<const Triangle> triangles, Tree& tree) : triangles_(triangles), tree_(tree) {}

    void build() {
        constexpr int REINSERTIONS = 4;
        if (!buildNodes(REINSERTIONS))
            buildNodes(0);
        writeLeaves();
    }

  private:
    /// False where reinsertion has made the binary tree too deep.
    bool buildNodes(int reinsertions) {
        BinaryTree binary = BinaryTreeBuilder(triangles_).build();
        if (binary.nodes.empty())
            return true;
        reinsert(binary, reinsertions);
        const binary::Collapse<Layout> collapse(binary, {binary});
        if (collapse.height() > Tree::MAX_DEPTH)
            return false;
        setScale(binary.nodes[0].bounds);
        size_ = collapse.extent();
        tree_.nodes = makeKernelArrayInHugePages<Node>(size_.nodes);
        order_ = makeKernelArray<std::uint32_t>(size_.triangles);
        collapse.write([&](const Extent& begin, auto children) {
            // V takes the last one first: the larger it is, the more likely something is in the
            // way.
            const auto boxOf = [&](const auto& child) {
                const binary::Bounds& bounds = binary.nodes[child.node].bounds;
                return Box{toFloats4(bounds.low), toFloats4(bounds.high)};
            };
            std::stable_sort(children.begin(), children.end(), [&](const auto& a, const auto& b) {
                return boxOf(a).halfArea() < boxOf(b).halfArea();
            });
            Node& node = tree_.nodes[begin.nodes];
            std::array<Box, Node::WIDTH> boxes;
            std::transform(children.begin(), children.end(), boxes.begin(), boxOf);
            node.setBoxes({boxes.data(), children.size()}, tree_.scale);
            for (std::size_t i = 0; i < Node::WIDTH; ++i) {
                const auto& child = children[std::min(i, children.size() - 1)];
                if (child.isLeaf)
                    node.setLeaf(i, appendToOrder(binary, child.node, child.begin.triangles));
                else
                    node.setNode(i, child.begin.nodes);
            }
        });
        return true;
    }

    /// The triangles below a binary node become a leaf.
    LeafAddress appendToOrder(const BinaryTree& binary, std::uint32_t node, std::uint32_t begin) {
        std::uint32_t end = begin;
        const auto append = [&](std::uint32_t triangle) {
            order_[end++] = triangle;
            return true;
        };
        binary.allBelow(node, append);
        return {begin, end - begin};
    }

    void setScale(const binary::Bounds& bounds) {
        float largest = 0;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max({largest, std::abs(bounds.low[axis]), std::abs(bounds.high[axis])});
        tree_.scale = std::ldexp(1.0, -std::ilogb(largest) - 1);
    }

    void writeLeaves() {
        tree_.leaves = makeKernelArrayInHugePages<std::uint8_t>(
            size_.triangles * Leaf::BYTES_PER_TRIANGLE + Leaf::BYTES_BEHIND);
#pragma omp parallel for
        for (std::uint32_t i = 0; i < size_.nodes; ++i)
            writeLeaves(tree_.nodes[i]);
    }

    void writeLeaves(const Node& node) {
        for (std::size_t child = 0; child < Node::WIDTH; ++child) {
            if (!node.hasBox(child) || !node.isLeaf(child))
                continue;
            const LeafAddress leaf = node.leaf(child);
            const LeafGrid grid(node, child);
            for (std::uint32_t i = 0; i < leaf.count(); ++i) {
                const std::uint32_t triangle = order_[leaf.first() + i];
                Leaf::write(tree_.leaves.get(), leaf, i, grid, triangle, triangles_[triangle],
                            tree_.scale);
            }
        }
    }

    std::span<const Triangle> triangles_;
    Tree& tree_;
    Extent size_;
    KernelArray<std::uint32_t> order_;  ///< of the triangles in leaves
};

}  // namespace

Tree buildTree(std::span<const Triangle> triangles) {
    Tree tree;
    Builder(triangles, tree).build();
    return tree;
}

}  // namespace bwfirt
