// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/WideTree.h"

#include "kernel/Collapse.h"
#include "kernel/Reinsertion.h"
#include "kernel/wide-bvh/BinaryTreeBuilder.h"
#include "kernel/wide-bvh/LeafContent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace bwfirt::wide {

namespace {

std::size_t linesOf(std::size_t bytes) {
    return (bytes + sizeof(Line) - 1) / sizeof(Line);
}

/// Sizes are in lines of memory.
class Layout {
  public:
    static constexpr std::size_t WIDTH = wide::WIDTH;
    static constexpr float NODE_COST = 1, LEAF_COST = 1, UNIT_COST = 0.15F;
    using Extent = std::size_t;

    Layout(std::span<const Triangle> triangles, const BinaryTree& tree)
        : triangles_(triangles), tree_(tree) {}

    std::uint8_t leafUnits(std::uint32_t node) const {
        LeafContent content;
        const bool fits = content.collect(triangles_, tree_, node);
        return fits ? static_cast<std::uint8_t>(linesOf(content.bytes())) : 0;
    }
    static Extent nodeExtent() { return sizeof(Node) / sizeof(Line); }
    static Extent leafExtent(std::uint8_t units) { return units; }

  private:
    std::span<const Triangle> triangles_;
    const BinaryTree& tree_;
};

float reachOf(const Bounds& bounds) {
    float reach = 0;
    for (int axis = 0; axis < 3; ++axis)
        reach = std::max({reach, std::abs(bounds.low[axis]), std::abs(bounds.high[axis])});
    return reach;
}

/// @param noChild what stands in place of children
Node emptyNode(std::uint32_t noChild) {
    constexpr float INFINITE = std::numeric_limits<float>::infinity();
    Node node;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.planes[axis].fill(INFINITE);
        node.planes[3 + axis].fill(-INFINITE);
    }
    node.children.fill(noChild);
    return node;
}

/// Children whose centres are farther along an octant's diagonal are likely to be met later. Where
/// there is no child, it comes first, since it is never met.
void setOrder(Node& node, std::size_t children) {
    node.order.fill(0);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        std::array<float, WIDTH> distances;
        distances.fill(std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < children; ++i) {
            distances[i] = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float sign = (octant >> axis & 1) != 0 ? -1.0F : 1.0F;
                distances[i] += sign * (node.planes[axis][i] / 2 + node.planes[3 + axis][i] / 2);
            }
        }
        std::array<std::uint32_t, WIDTH> lanes;
        std::iota(lanes.begin(), lanes.end(), 0U);
        std::sort(lanes.begin(), lanes.end(), [&](std::uint32_t a, std::uint32_t b) {
            return distances[a] != distances[b] ? distances[a] > distances[b] : a < b;
        });
        for (std::size_t i = 0; i < WIDTH; ++i)
            node.order[i] |= lanes[i] << Node::shift(octant);
    }
}

}  // namespace

WideTree::WideTree(std::span<const Triangle> triangles) {
    constexpr int REINSERTIONS = 3;
    if (!build(triangles, REINSERTIONS))
        build(triangles, 0);
}

bool WideTree::build(std::span<const Triangle> triangles, int reinsertions) {
    BinaryTree binary = buildBinaryTree(triangles);
    if (binary.nodes.empty())
        return true;
    reinsert(binary, reinsertions);
    const Collapse<Layout> collapse(binary, {triangles, binary});
    if (collapse.height() > BinaryTree::MAX_DEPTH)
        return false;
    const std::size_t size = collapse.extent();
    if (size >= Child::MOST_LINES)
        throw std::length_error("the tree has more nodes than it can number");
    end_ = Child::LEAF | static_cast<std::uint32_t>(size + 1);
    reach_ = reachOf(binary.nodes[0].bounds);
    lines_ = makeKernelArrayInHugePages<Line>(size + END_LINES);
    std::fill_n(lines_.get() + size, END_LINES, Line{});
    collapse.write([&](std::size_t begin, const auto& children) {
        Node node = emptyNode(Child::LEAF | static_cast<std::uint32_t>(size));
        for (std::size_t i = 0; i < children.size(); ++i) {
            const auto& child = children[i];
            const Bounds& bounds = binary.nodes[child.node].bounds;
            for (int axis = 0; axis < 3; ++axis) {
                node.planes[static_cast<std::size_t>(axis)][i] = bounds.low[axis];
                node.planes[static_cast<std::size_t>(axis) + 3][i] = bounds.high[axis];
            }
            node.children[i] =
                static_cast<std::uint32_t>(child.begin) | (child.isLeaf ? Child::LEAF : 0);
            if (!child.isLeaf)
                continue;
            LeafContent content;
            content.collect(triangles, binary, child.node);
            content.write(&lines_[child.begin]);
        }
        setOrder(node, children.size());
        std::memcpy(&lines_[begin], &node, sizeof node);
    });
    return true;
}

}  // namespace bwfirt::wide
