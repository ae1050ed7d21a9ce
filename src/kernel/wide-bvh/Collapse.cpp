// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/Collapse.h"

#include "kernel/wide-bvh/LeafContent.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace bwfirt::wide {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

std::size_t linesOf(std::size_t bytes) {
    return (bytes + sizeof(Line) - 1) / sizeof(Line);
}

float halfArea(const Bounds& bounds) {
    const V3d size = V3d(bounds.high) - V3d(bounds.low);
    return static_cast<float>(size.x * size.y + size.y * size.z + size.z * size.x);
}

Node emptyNode(std::uint32_t noChild) {
    Node node;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.planes[axis].fill(INFINITE);
        node.planes[3 + axis].fill(-INFINITE);
    }
    node.children.fill(noChild);
    return node;
}

}  // namespace

Collapse::Collapse(std::span<const Triangle> triangles, const BinaryTree& tree)
    : triangles_(triangles),
      tree_(tree),
      weights_(tree.nodes.size()),
      isOneWeighed_(tree.parents.size()),
      sizes_(tree.nodes.size()) {
#pragma omp parallel
#pragma omp single
    descend(0, 0);
    measure();
}

/// Weighs all that is below a node. No task waits for another, which would leave its thread idle
/// where one child of a node has much more below it than the other.
void Collapse::descend(std::uint32_t index, int depth) {
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

/// Weighs a leaf and then one node after the other on the way to the root, as far as both children
/// have been weighed: the thread that weighs the second one goes on.
void Collapse::ascend(std::uint32_t index) {
    weigh(index);
    while (index != 0 && std::atomic_ref(isOneWeighed_[index / 2]).exchange(1) != 0) {
        index = tree_.parents[index / 2];
        weigh(index);
    }
}

void Collapse::weigh(std::uint32_t index) {
    const BinaryNode& node = tree_.nodes[index];
    const float area = halfArea(node.bounds);
    Weight& weight = weights_[index];
    weight.costs.fill(INFINITE);
    weight.leafLines = 0;
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
    weight.costs[0] = weight.costs[WIDTH - 1] + area * NODE_COST;
    if (first.leafLines > 0 && second.leafLines > 0)
        weighAsLeaf(index, area);
    for (std::size_t i = 1; i < WIDTH; ++i)
        weight.costs[i] = std::min(weight.costs[i], weight.costs[i - 1]);
}

void Collapse::weighAsLeaf(std::uint32_t index, float area) {
    LeafContent content;
    if (!content.collect(triangles_, tree_, index))
        return;
    Weight& weight = weights_[index];
    weight.leafLines = static_cast<std::uint8_t>(linesOf(content.bytes()));
    const float cost = area * (LEAF_COST + LINE_COST * weight.leafLines);
    weight.isLeaf = cost <= weight.costs[0];
    weight.costs[0] = std::min(weight.costs[0], cost);
}

std::size_t Collapse::shareOfFirst(const BinaryNode& node, std::size_t most) const {
    const auto &one = weights_[node.first].costs, &other = weights_[node.first + 1].costs;
    std::size_t best = 1;
    for (std::size_t share = 2; share < most; ++share)
        if (one[share - 1] + other[most - share - 1] < one[best - 1] + other[most - best - 1])
            best = share;
    return best;
}

Collapse::Children Collapse::childrenOf(std::uint32_t index) const {
    Children children;
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

void Collapse::split(std::uint32_t index, std::size_t most, Children& children) const {
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

Collapse::Children Collapse::wideOf(const Children& children) const {
    Children wide;
    for (const std::uint32_t child : children)
        if (!weights_[child].isLeaf)
            wide.add(child);
    return wide;
}

template <typename T, typename ChildrenOf>
std::size_t Collapse::unfold(KernelVector<T>& nodes, const ChildrenOf& childrenOf) {
    std::size_t top = 0;
    for (; top < nodes.size() && nodes.size() < PARTS; ++top)
        for (const T& child : childrenOf(nodes[top]))
            nodes.push_back(child);
    return top;
}

void Collapse::measure() {
    KernelVector<std::uint32_t> nodes{0};
    std::size_t top = unfold(nodes, [&](std::uint32_t node) { return wideOf(childrenOf(node)); });
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = top; i < nodes.size(); ++i)
        measureBelow(nodes[i]);
    while (top-- > 0)
        measure(nodes[top], childrenOf(nodes[top]));
}

void Collapse::measureBelow(std::uint32_t index) {
    const Children children = childrenOf(index);
    for (const std::uint32_t child : wideOf(children))
        measureBelow(child);
    measure(index, children);
}

void Collapse::measure(std::uint32_t index, const Children& children) {
    std::size_t size = sizeof(Node) / sizeof(Line);
    for (const std::uint32_t child : children)
        size += weights_[child].isLeaf ? weights_[child].leafLines : sizes_[child];
    sizes_[index] = size;
}

void Collapse::write(Line* lines) const {
    KernelVector<Part> parts{{0, 0}};
    const std::size_t top = unfold(parts, [&](const Part& part) { return write(part, lines); });
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = top; i < parts.size(); ++i)
        writeBelow(parts[i], lines);
}

void Collapse::writeBelow(const Part& part, Line* lines) const {
    for (const Part& child : write(part, lines))
        writeBelow(child, lines);
}

Collapse::Some<Collapse::Part> Collapse::write(const Part& part, Line* lines) const {
    const Children children = childrenOf(part.node);
    Some<Part> others;
    Node node = emptyNode(Child::LEAF | static_cast<std::uint32_t>(size()));
    std::size_t next = part.line + sizeof(Node) / sizeof(Line);
    const auto place = [&](std::size_t i, std::uint32_t bits, std::size_t size) {
        const Bounds& bounds = tree_.nodes[children[i]].bounds;
        for (int axis = 0; axis < 3; ++axis) {
            node.planes[static_cast<std::size_t>(axis)][i] = bounds.low[axis];
            node.planes[static_cast<std::size_t>(axis) + 3][i] = bounds.high[axis];
        }
        node.children[i] = static_cast<std::uint32_t>(next) | bits;
        next += size;
    };
    for (std::size_t i = 0; i < children.size(); ++i) {
        const Weight& weight = weights_[children[i]];
        if (!weight.isLeaf)
            continue;
        LeafContent content;
        content.collect(triangles_, tree_, children[i]);
        content.write(&lines[next]);
        place(i, Child::LEAF, weight.leafLines);
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
        const std::uint32_t child = children[i];
        if (weights_[child].isLeaf)
            continue;
        others.add({child, next});
        place(i, 0, sizes_[child]);
    }
    std::memcpy(&lines[part.line], &node, sizeof node);
    return others;
}

}  // namespace bwfirt::wide
