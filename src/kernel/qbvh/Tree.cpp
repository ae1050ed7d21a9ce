// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/qbvh/Tree.h"

#include "kernel/qbvh/Leaf.h"
#include "kernel/qbvh/Split.h"

#include <atomic>
#include <cmath>
#include <stdexcept>

namespace bwfirt {

namespace {

class Builder {
  public:
    Builder(std::span<const Triangle> triangles, Tree& tree) : triangles_(triangles), tree_(tree) {}

    void build() {
        collectReferences();
        if (count_ == 0)
            return;
        if (count_ > LeafAddress::MOST_ADDRESSES)
            throw std::length_error("more triangles than a leaf can refer to");
        // Every node has an inner node and three leaves of one triangle at worst, see split().
        tree_.nodes = makeKernelArrayInHugePages<Node>(count_ / 3 + 1);
#pragma omp parallel
#pragma omp single
        buildRoot();
        shrink(tree_.nodes, nodeCount_);
        tree_.leaves = makeKernelArrayInHugePages<std::uint8_t>(count_ * Leaf::BYTES_PER_TRIANGLE +
                                                                Leaf::BYTES_BEHIND);
        const std::uint32_t nodeCount = nodeCount_;
#pragma omp parallel for
        for (std::uint32_t i = 0; i < nodeCount; ++i)
            writeLeaves(tree_.nodes[i]);
    }

  private:
    /// Groups of fewer references are built by one thread.
    static constexpr std::size_t TASK_SIZE = 1 << 10;

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

    void buildRoot() {
        const Group root = groupOf({references_.get(), count_});
        float largest = 0;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(
                {largest, std::abs(root.bounds.low[axis]), std::abs(root.bounds.high[axis])});
        tree_.scale = std::ldexp(1.0, -std::ilogb(largest) - 1);
        nodeCount_ = 1;
        buildNode(0, root, 0);
    }

    void buildNode(std::uint32_t index, const Group& group, int depth) {
        std::array<Group, Node::WIDTH> groups;
        const std::size_t count = split(group, depth, groups);
        std::array<Bounds, Node::WIDTH> boxes;
        std::uint32_t innerCount = 0;
        for (std::size_t i = 0; i < count; ++i) {
            boxes[i] = groups[i].bounds;
            innerCount += isLeaf(groups[i]) ? 0 : 1;
        }
        Node& node = tree_.nodes[index];
        node.setBoxes({boxes.data(), count}, tree_.scale);
        std::uint32_t nextNode = nodeCount_.fetch_add(innerCount);
        for (std::size_t i = 0; i < Node::WIDTH; ++i) {
            const Group& child = groups[std::min(i, count - 1)];
            if (isLeaf(child)) {
                const auto first = child.references.data() - references_.get();
                node.setLeaf(i, {static_cast<std::uint32_t>(first),
                                 static_cast<std::uint32_t>(child.size())});
            } else {
                const std::uint32_t childIndex = nextNode++;
                node.setNode(i, childIndex);
#pragma omp task default(none) firstprivate(childIndex, child, depth) if (child.size() > TASK_SIZE)
                buildNode(childIndex, child, depth + 1);
            }
        }
    }

    void writeLeaves(const Node& node) {
        for (std::size_t child = 0; child < Node::WIDTH; ++child) {
            if (!node.hasBox(child) || !node.isLeaf(child))
                continue;
            const LeafAddress leaf = node.leaf(child);
            const LeafGrid grid(node, child);
            for (std::uint32_t i = 0; i < leaf.count(); ++i) {
                const std::uint32_t triangle = references_[leaf.first() + i].triangle;
                Leaf::write(tree_.leaves.get(), leaf, i, grid, triangle, triangles_[triangle],
                            tree_.scale);
            }
        }
    }

    static bool isLeaf(const Group& group) {
        return group.size() <= LeafAddress::MOST_TRIANGLES;
    }

    /// Splits the group into at most four, and returns their number. What is too large for a leaf
    /// is split first, so that a node has less than four children only where all of them are
    /// leaves.
    static std::size_t split(const Group& group, int depth,
                             std::array<Group, Node::WIDTH>& groups) {
        groups[0] = group;
        std::size_t count = 1;
        while (count < Node::WIDTH) {
            Group* widest = nullptr;
            for (Group& candidate : std::span(groups.data(), count))
                if (candidate.size() > 1 &&
                    (!widest || isToBeSplitBefore(candidate, *widest, depth)))
                    widest = &candidate;
            if (!widest)
                break;
            std::optional<Parts> parts;
            if (depth < Tree::MAX_SAH_DEPTH)
                parts = splitBySah(*widest);
            if (!parts)
                parts = halve(*widest);
            *widest = parts->first;
            groups[count++] = parts->second;
        }
        return count;
    }

    static bool isToBeSplitBefore(const Group& a, const Group& b, int depth) {
        if (isLeaf(a) != isLeaf(b))
            return isLeaf(b);
        if (depth >= Tree::MAX_SAH_DEPTH)
            return a.size() > b.size();
        return halfArea(a.bounds) > halfArea(b.bounds);
    }

    std::span<const Triangle> triangles_;
    Tree& tree_;
    KernelArray<Reference> references_;
    std::size_t count_ = 0;
    std::atomic<std::uint32_t> nodeCount_ = 0;
};

}  // namespace

Tree buildTree(std::span<const Triangle> triangles) {
    Tree tree;
    Builder(triangles, tree).build();
    return tree;
}

}  // namespace bwfirt
