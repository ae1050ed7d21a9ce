// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/Tree.h"

#include "kernel/bih/EmptySpace.h"
#include "kernel/bih/Grid.h"
#include "kernel/bih/Keys.h"

#include <stdexcept>

namespace bwfirt {

namespace {

class Builder {
  public:
    Builder(std::span<const Triangle> triangles, const KeyFormat& format, const Keys& keys,
            Tree& tree, NodePairs& pairs, Box* bounds)
        : triangles_(triangles),
          format_(format),
          keys_(keys),
          tree_(tree),
          pairs_(pairs),
          bounds_(bounds) {}

    /// @return the bounds of the triangles
    Box build(Node& node, std::span<Key> keys, int depth, bool isSorted) {
        if (keys.size() <= LEAF_SIZE)
            return makeLeaf(node, keys);
        if (!isSorted && (keys.front() ^ keys.back()) >> format_.bucketShift() == 0) {
            sortBucket(keys, keys_.buffer.get() + (keys.data() - keys_.keys.get()), format_);
            isSorted = true;
        }
        const auto [axis, firstSize] = chooseSplit(keys, depth);
        const std::span<Key> firstKeys = keys.first(firstSize),
                             secondKeys = keys.subspan(firstSize);
        const std::uint32_t place = pairs_.take();
        auto& children = pairs_[place];
        Box first, second;
        if (keys.size() > TASK_SIZE) {
#pragma omp task default(shared)
            first = build(children[0], firstKeys, depth + 1, isSorted);
            second = build(children[1], secondKeys, depth + 1, isSorted);
#pragma omp taskwait
        } else {
            first = build(children[0], firstKeys, depth + 1, isSorted);
            second = build(children[1], secondKeys, depth + 1, isSorted);
        }
        node =
            Node::inner(static_cast<std::size_t>(axis), first.high[axis], second.low[axis], place);
        first.extend(second);
        return bounds_[place] = first;
    }

  private:
    static constexpr std::size_t LEAF_SIZE = 8;
    /// Longer lists are worth a task of their own.
    static constexpr std::size_t TASK_SIZE = 4096;
    /// From this depth on lists are halved, which takes at most 32 more levels.
    static constexpr int MAX_GRID_SPLITS = Tree::MAX_SPLITS - 32;

    struct Split {
        int axis;
        std::size_t firstSize;
    };

    Box makeLeaf(Node& node, std::span<const Key> keys) const {
        const auto place = static_cast<std::uint32_t>(keys.data() - keys_.keys.get());
        node = Node::leaf(place, static_cast<std::uint32_t>(keys.size()));
        Box bounds;
        for (std::uint32_t i = 0; i < keys.size(); ++i) {
            const std::uint32_t triangle = format_.triangle(keys[i]);
            tree_.order[place + i] = triangle;
            bounds.extend(boxOf(triangles_[triangle]));
        }
        bounds.low[3] = bounds.high[3] = 0;
        return bounds;
    }

    /// Where the first of the bits in which the cells differ changes.
    Split chooseSplit(std::span<Key> keys, int depth) const {
        if (depth < MAX_GRID_SPLITS) {
            if (format_.cell(keys.front()) == format_.cell(keys.back()))
                refine(keys);
            const Key difference = format_.cell(keys.front() ^ keys.back());
            if (difference != 0) {
                const int bit = std::bit_width(difference) - 1;
                const auto second = std::ranges::partition_point(
                    keys, [=, this](Key key) { return (format_.cell(key) >> bit & 1) == 0; });
                return {Grid::axisOf(bit), static_cast<std::size_t>(second - keys.begin())};
            }
        }
        return {0, keys.size() / 2};
    }

    /// Makes keys anew that are all in the same cell, by a grid in this cell.
    void refine(std::span<Key> keys) const {
        const auto centre = [&](Key key) { return centreOf(triangles_[format_.triangle(key)]); };
        Box centres;
        for (const Key key : keys)
            centres.extend({centre(key), centre(key)});
        const Grid grid(centres, format_.axisBits());
        for (Key& key : keys)
            key = format_.make(grid.cellAround(centre(key)), format_.triangle(key));
        std::ranges::sort(keys);
    }

    std::span<const Triangle> triangles_;
    const KeyFormat& format_;
    const Keys& keys_;
    Tree& tree_;
    NodePairs& pairs_;
    Box* bounds_;  ///< of inner nodes, by the place of their children
};

}  // namespace

Tree buildTree(std::span<const Triangle> triangles) {
    if (triangles.size() > Node::MOST_PAIRS / 2)
        throw std::length_error("more triangles than the hierarchy can number");
    const KeyFormat format(triangles.size());
    Keys keys = makeKeys(triangles, format);

    Tree tree;
    tree.order = makeKernelArray<std::uint32_t>(keys.size);
    NodePairs pairs(keys.size);
    const auto bounds = makeKernelArray<Box>(pairs.roomFor(keys.size), alignof(Box));
    Builder builder(triangles, format, keys, tree, pairs, bounds.get());
#pragma omp parallel
#pragma omp single
    tree.bounds = builder.build(tree.root, {keys.keys.get(), keys.size}, 0, false);

    keys = {};  // the copy takes its room
    NodePairs targets(2 * pairs.size());
    tree.root = cutOffEmptySpace(tree.root, tree.bounds, pairs, bounds.get(), targets);
    tree.children = targets.release();
    return tree;
}

}  // namespace bwfirt
