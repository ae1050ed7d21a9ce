// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/WideTree.h"

#include "kernel/wide-bvh/Collapse.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace bwfirt::wide {

namespace {

constexpr std::size_t HUGE_PAGE = std::size_t{2} << 20;

/// Lines of memory, in huge pages where there are enough of them: an incoherent ray touches many
/// pages, and each look into the page table that is saved counts.
KernelArray<Line> allocateLines(std::size_t count) {
    const std::size_t bytes = count * sizeof(Line);
    const bool isLarge = bytes >= HUGE_PAGE;
    KernelArray<Line> lines = makeKernelArray<Line>(count, isLarge ? HUGE_PAGE : alignof(Line));
#ifdef __linux__
    if (isLarge)
        madvise(lines.get(), bytes / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE);
#endif
    return lines;
}

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
    lines_ = allocateLines(size + END_LINES);
    std::fill_n(lines_.get() + size, END_LINES, Line{});
    collapse.write(lines_.get());
    return true;
}

}  // namespace bwfirt::wide
