// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/WideTree.h"

#include "kernel/wide-bvh/Collapse.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bwfirt::wide {

namespace {

float reachOf(const Bounds& bounds) {
    float reach = 0;
    for (int axis = 0; axis < 3; ++axis)
        reach = std::max({reach, std::abs(bounds.low[axis]), std::abs(bounds.high[axis])});
    return reach;
}

}  // namespace

WideTree::WideTree(std::span<const Triangle> triangles) {
    if (!build(triangles, {}))
        build(triangles, {.reinsertions = 0});
}

bool WideTree::build(std::span<const Triangle> triangles, const BinaryTreeSettings& settings) {
    const BinaryTree binary = buildBinaryTree(triangles, settings);
    if (binary.nodes.empty())
        return true;
    const Collapse collapse(triangles, binary);
    if (collapse.height() > BinaryTree::MAX_DEPTH)
        return false;
    const std::size_t size = collapse.size();
    if (size >= Child::MOST_LINES)
        throw std::length_error("the tree has more nodes than it can number");
    reach_ = reachOf(binary.nodes[0].bounds);
    lines_ = makeKernelArrayInHugePages<Line>(size + END_LINES);
    std::fill_n(lines_.get() + size, END_LINES, Line{});
    collapse.write(lines_.get());
    return true;
}

}  // namespace bwfirt::wide
