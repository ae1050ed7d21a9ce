// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/EmptySpace.h"

#include <limits>

namespace bwfirt {

namespace {

class EmptySpace {
  public:
    EmptySpace(const NodePairs& sources, const Box* bounds, NodePairs& targets)
        : sources_(sources), bounds_(bounds), targets_(targets) {}

    /// @param interval what a ray knows of the bounds on its way down
    void copy(const Node& source, Node* target, Box interval, int depth) {
        if (source.isLeaf()) {
            *target = source;
            return;
        }
        target = cutOff(target, bounds_[source.children()], interval);
        Box first = interval, second = interval;
        first.high[static_cast<int>(source.axis())] = source.firstHigh();
        second.low[static_cast<int>(source.axis())] = source.secondLow();
        const Node* const from = sources_[source.children()].data();
        const std::uint32_t place = targets_.take();
        Node* const to = targets_[place].data();
        *target = Node::inner(source.axis(), source.firstHigh(), source.secondLow(), place);
        if (depth < PARALLEL_DEPTH) {
#pragma omp task firstprivate(first, depth)
            copy(from[0], to, first, depth + 1);
        } else {
            copy(from[0], to, first, depth + 1);
        }
        copy(from[1], to + 1, second, depth + 1);
    }

  private:
    static constexpr int PARALLEL_DEPTH = 8;
    /// A share of the interval that is worth a node of its own when it is empty.
    static constexpr float MUCH_EMPTY_SPACE = 0.2F;

    /// Of several sides with much empty space, the one with the most is cut off.
    /// @return the node for what is not empty: the target, or one of its children
    Node* cutOff(Node* target, const Box& bounds, Box& interval) {
        const Floats4 below = bounds.low - interval.low;
        const Floats4 above = interval.high - bounds.high;
        const Floats4 larger = max(below, above);
        const Floats4 enough = MUCH_EMPTY_SPACE * (interval.high - interval.low);
        const Floats4 empty([&](auto i) { return larger[i] > enough[i] ? larger[i] : 0.0F; });
        if (none_of(empty > 0))
            return target;

        int axis = empty[0] > empty[1] ? 0 : 1;
        axis = empty[axis] > empty[2] ? axis : 2;
        constexpr float INFINITE = std::numeric_limits<float>::infinity();
        const float low = bounds.low[axis], high = bounds.high[axis];
        const std::uint32_t place = targets_.take();
        NodePair& children = targets_[place];
        if (below[axis] > above[axis]) {
            *target = Node::inner(static_cast<std::size_t>(axis), -INFINITE, low, place);
            interval.low[axis] = low;
            children[0] = Node::leaf(0, 0);
            return &children[1];
        }
        *target = Node::inner(static_cast<std::size_t>(axis), high, INFINITE, place);
        interval.high[axis] = high;
        children[1] = Node::leaf(0, 0);
        return &children[0];
    }

    const NodePairs& sources_;
    const Box* bounds_;
    NodePairs& targets_;
};

}  // namespace

Node cutOffEmptySpace(const Node& root, const Box& rootBounds, const NodePairs& source,
                      const Box* bounds, NodePairs& target) {
    EmptySpace emptySpace(source, bounds, target);
    Node result;
#pragma omp parallel
#pragma omp single
    emptySpace.copy(root, &result, rootBounds, 0);
    return result;
}

}  // namespace bwfirt
