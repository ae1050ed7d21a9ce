// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/Tree.h"

#include <omp.h>

#include <atomic>
#include <limits>
#include <optional>
#include <stdexcept>

namespace bwfirt {

namespace {

/// References that become a subtree.
struct Range {
    Reference* begin;
    Reference* end;
    Box bounds;
    Box cell;      ///< of the regular grid, with the centres of the boxes
    Box interval;  ///< what a ray knows of the bounds on its way down

    std::ptrdiff_t size() const { return end - begin; }
};

struct Plane {
    int axis;
    float position;
};

/// The next plane of the regular grid with references on both sides, as far as the bounds can tell.
/// Each cell of the grid is halved across its longest side; halves that are empty are left out.
/// Nothing where a cell is too small to be halved.
std::optional<Plane> findPlane(Range& range) {
    while (true) {
        const int axis = range.cell.longestAxis();
        const float low = range.cell.low[axis], high = range.cell.high[axis];
        const float middle = 0.5F * low + 0.5F * high;
        if (!(low < middle && middle < high))
            return std::nullopt;
        if (middle > range.bounds.high[axis])
            range.cell.high[axis] = middle;
        else if (middle <= range.bounds.low[axis])
            range.cell.low[axis] = middle;
        else
            return Plane{axis, middle};
    }
}

class Builder {
  public:
    /// @param children room for those of mostInner() nodes
    Builder(const Reference* references, std::array<Node, 2>* children)
        : references_(references),
          children_(children),
          places_(static_cast<std::size_t>(omp_get_max_threads())) {}

    /// Room for the children of so many nodes is enough: each node with two children that hold
    /// triangles may have one in front of it that cuts off empty space.
    static std::size_t mostInner(std::size_t referenceCount) {
        return 2 * referenceCount + PLACES * static_cast<std::size_t>(omp_get_max_threads());
    }

    void build(Node* node, Range range, int depth) {
        if (range.size() <= LEAF_SIZE) {
            *node = Node::leaf(static_cast<std::uint32_t>(range.begin - references_),
                               static_cast<std::uint32_t>(range.size()));
            return;
        }
        node = cutOffEmptySpace(node, range);
        const Split split = chooseSplit(range, depth);
        Node* const children = makeChildren(node, split.axis, split.first.bounds.high[split.axis],
                                            split.second.bounds.low[split.axis]);
        if (range.size() > TASK_SIZE) {
#pragma omp task
            build(children, split.first, depth + 1);
        } else {
            build(children, split.first, depth + 1);
        }
        build(children + 1, split.second, depth + 1);
    }

    std::size_t innerCount() const {
        return innerCount_;
    }

  private:
    static constexpr std::uint32_t PLACES = 64;
    static constexpr std::ptrdiff_t LEAF_SIZE = 8;
    /// From this depth on ranges are halved, which takes at most 32 more levels.
    static constexpr int MAX_GRID_SPLITS = Tree::MAX_SPLITS - 32;
    /// A share of the interval that is worth a node of its own when it is empty.
    static constexpr float MUCH_EMPTY_SPACE = 0.2F;

    struct Split {
        int axis;
        Range first;
        Range second;

        Split(int axis, const Range& range, const Parts& parts)
            : axis(axis),
              first{parts.begin, parts.middle, parts.firstBounds, range.cell, range.interval},
              second{parts.middle, parts.end, parts.secondBounds, range.cell, range.interval} {
            first.interval.high[axis] = first.bounds.high[axis];
            second.interval.low[axis] = second.bounds.low[axis];
        }
    };

    Node* makeChildren(Node* parent, int axis, float firstHigh, float secondLow) {
        auto& [next, end] = places_[static_cast<std::size_t>(omp_get_thread_num())];
        if (next == end) {
            next = innerCount_.fetch_add(PLACES);
            end = next + PLACES;
        }
        const std::uint32_t place = next++;
        *parent = Node::inner(static_cast<std::size_t>(axis), firstHigh, secondLow, place);
        return children_[place].data();
    }

    /// Where the interval is empty over much of its length, the node gets an empty child there.
    /// @return the node for the range: this one, or its other child
    Node* cutOffEmptySpace(Node* node, Range& range) {
        const Floats4 below = range.bounds.low - range.interval.low;
        const Floats4 above = range.interval.high - range.bounds.high;
        const Floats4 larger = max(below, above);
        const Floats4 enough = MUCH_EMPTY_SPACE * (range.interval.high - range.interval.low);
        const Floats4 empty([&](auto i) { return larger[i] > enough[i] ? larger[i] : 0.0F; });
        if (none_of(empty > 0))
            return node;

        int axis = empty[0] > empty[1] ? 0 : 1;
        axis = empty[axis] > empty[2] ? axis : 2;
        constexpr float INFINITE = std::numeric_limits<float>::infinity();
        const float low = range.bounds.low[axis], high = range.bounds.high[axis];
        if (below[axis] > above[axis]) {
            range.interval.low[axis] = low;
            Node* const children = makeChildren(node, axis, -INFINITE, low);
            children[0] = Node::leaf(0, 0);
            return &children[1];
        }
        range.interval.high[axis] = high;
        Node* const children = makeChildren(node, axis, high, INFINITE);
        children[1] = Node::leaf(0, 0);
        return &children[0];
    }

    static Split chooseSplit(Range range, int depth) {
        while (depth < MAX_GRID_SPLITS) {
            const std::optional<Plane> found = findPlane(range);
            if (!found)
                break;
            const Plane plane = *found;
            const Parts parts =
                partition(range.begin, range.end, [plane](const Reference& reference) {
                    return reference.centre(plane.axis) < plane.position;
                });
            if (parts.middle == range.begin) {
                range.cell.low[plane.axis] = plane.position;
            } else if (parts.middle == range.end) {
                range.cell.high[plane.axis] = plane.position;
            } else {
                Split split(plane.axis, range, parts);
                split.first.cell.high[plane.axis] = plane.position;
                split.second.cell.low[plane.axis] = plane.position;
                return split;
            }
        }
        const Reference* const middle = range.begin + range.size() / 2;
        const auto isInFirst = [middle](const Reference& reference) { return &reference < middle; };
        return {range.bounds.longestAxis(), range, partition(range.begin, range.end, isInFirst)};
    }

    /// Places for children that a thread has taken and not yet used; in a cache line of its own.
    struct alignas(64) Places {
        std::uint32_t next = 0;
        std::uint32_t end = 0;
    };

    const Reference* references_;
    std::array<Node, 2>* children_;
    KernelVector<Places> places_;  ///< by thread
    std::atomic<std::uint32_t> innerCount_ = 0;
};

}  // namespace

Tree buildTree(std::span<const Triangle> triangles) {
    const std::size_t count = triangles.size();
    if (count > Node::MOST_PAIRS / 2)
        throw std::length_error("more triangles than the hierarchy can number");
    Tree tree;
    auto references = makeKernelArray<Reference>(count);
    tree.children = makeKernelArray<std::array<Node, 2>>(Builder::mostInner(count));
    Builder builder(references.get(), tree.children.get());
    Reference* end = nullptr;
#pragma omp parallel
    {
#pragma omp for
        for (std::size_t i = 0; i < count; ++i)
            new (&references[i]) Reference(triangles[i], static_cast<std::uint32_t>(i));
#pragma omp single
        {
            Reference* const begin = references.get();
            const Parts parts = partition(begin, begin + count, [](const Reference& reference) {
                return !reference.boxWithIndex().isEmpty();
            });
            end = parts.middle;
            tree.bounds = parts.firstBounds;
            builder.build(&tree.root, {begin, end, tree.bounds, tree.bounds, tree.bounds}, 0);
        }
    }
    shrink(tree.children, builder.innerCount());
    const auto size = static_cast<std::size_t>(end - references.get());
    tree.order = makeKernelArray<std::uint32_t>(size);
#pragma omp parallel for
    for (std::size_t i = 0; i < size; ++i)
        tree.order[i] = references[i].triangle();
    return tree;
}

}  // namespace bwfirt
