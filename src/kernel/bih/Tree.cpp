// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/Tree.h"

#include "kernel/bih/EmptySpace.h"
#include "kernel/bih/Grid.h"
#include "kernel/bih/Keys.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace bwfirt {

namespace {

class Builder {
    /// A node to be made, and the keys of its triangles.
    struct Part {
        Node* node;
        std::span<Key> keys;
        int depth;
        bool isSorted;
    };

    /// The two parts of a part, whose nodes are the pair at `place`.
    struct Division {
        int axis;
        std::uint32_t place;
        std::array<Part, 2> parts;
    };

  public:
    Builder(std::span<const Triangle> triangles, const KeyFormat& format, const Keys& keys,
            Tree& tree, NodePairs& pairs, Box* bounds)
        : triangles_(triangles),
          format_(format),
          keys_(keys),
          tree_(tree),
          pairs_(pairs),
          bounds_(bounds) {}

    /// Long lists are divided one after the other, which takes little time: most of the keys need
    /// not be looked at. The short lists that come of it are built side by side. A task for each
    /// long list would have to wait for the tasks of its parts.
    /// @return how many lists were long; the children of their nodes have the first places
    std::size_t build(Node& root, Box& bounds) {
        struct TopPart {
            Part part;
            Box bounds;
            std::optional<Division> division;
            std::size_t children = 0;  ///< index of the first of two
        };
        const std::size_t longSize = std::max(keys_.size / SHORT_LISTS, LEAF_SIZE) + 1;
        std::vector<TopPart> top{{{&root, {keys_.keys.get(), keys_.size}, 0, false}, {}, {}}};
        for (std::size_t i = 0; i < top.size(); ++i) {
            if (top[i].part.keys.size() < longSize)
                continue;
            const Division division = divide(top[i].part);
            top[i].division = division;
            top[i].children = top.size();
            for (const Part& part : division.parts)
                top.push_back({part, {}, {}});
        }
#pragma omp parallel for schedule(dynamic)
        for (TopPart& one : top)
            if (!one.division)
                one.bounds = build(one.part);
        for (auto one = top.rbegin(); one != top.rend(); ++one)
            if (one->division)
                one->bounds = join(*one->part.node, *one->division, top[one->children].bounds,
                                   top[one->children + 1].bounds);
        bounds = top.front().bounds;
        return top.size() / 2;
    }

  private:
    static constexpr std::size_t LEAF_SIZE = 8;
    /// Lists are short where there is room for so many of them.
    static constexpr std::size_t SHORT_LISTS = 64;
    /// From this depth on lists are halved, which takes at most 32 more levels.
    static constexpr int MAX_GRID_SPLITS = Tree::MAX_SPLITS - 32;

    Box build(const Part& part) {
        if (part.keys.size() <= LEAF_SIZE)
            return makeLeaf(*part.node, part.keys);
        const Division division = divide(part);
        const Box first = build(division.parts[0]), second = build(division.parts[1]);
        return join(*part.node, division, first, second);
    }

    Division divide(const Part& part) {
        const auto [node, keys, depth, wasSorted] = part;
        const bool isSorted =
            wasSorted || (keys.front() ^ keys.back()) >> format_.bucketShift() == 0;
        if (isSorted && !wasSorted)
            sortBucket(keys, keys_.buffer.get() + (keys.data() - keys_.keys.get()), format_);
        const auto [axis, firstSize] = chooseSplit(keys, depth);
        const std::uint32_t place = pairs_.take();
        NodePair& nodes = pairs_[place];
        return {axis,
                place,
                {Part{&nodes[0], keys.first(firstSize), depth + 1, isSorted},
                 Part{&nodes[1], keys.subspan(firstSize), depth + 1, isSorted}}};
    }

    /// Makes the node of both parts. @return its bounds
    Box join(Node& node, const Division& division, const Box& first, const Box& second) {
        const auto [axis, place, parts] = division;
        node =
            Node::inner(static_cast<std::size_t>(axis), first.high[axis], second.low[axis], place);
        bounds_[place] = first;
        bounds_[place].extend(second);
        return bounds_[place];
    }

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
    const std::size_t longLists = builder.build(tree.root, tree.bounds);

    keys = {};  // the copy takes its room
    NodePairs targets(2 * pairs.size());
    tree.root = cutOffEmptySpace(tree.root, tree.bounds, pairs, longLists, bounds.get(), targets);
    tree.children = targets.release();
    return tree;
}

}  // namespace bwfirt
