// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/EmptySpace.h"

#include <limits>

namespace bwfirt {

namespace {

class EmptySpace {
  public:
    EmptySpace(const NodePairs& sources, std::size_t longLists, const Box* bounds,
               NodePairs& targets)
        : sources_(sources), longLists_(longLists), bounds_(bounds), targets_(targets) {}

    /// @param interval what a ray knows of the bounds on its way down
    void copy(const Node& source, Node* target, Box interval) {
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
        if (source.children() < longLists_) {
#pragma omp task firstprivate(first)
            copy(from[0], to, first);
        } else {
            copy(from[0], to, first);
        }
        copy(from[1], to + 1, second);
    }

  private:
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
    std::size_t longLists_;
    const Box* bounds_;
    NodePairs& targets_;
};

}  // namespace

Node cutOffEmptySpace(const Node& root, const Box& rootBounds, const NodePairs& source,
                      std::size_t longLists, const Box* bounds, NodePairs& target) {
    EmptySpace emptySpace(source, longLists, bounds, target);
    Node result;
#pragma omp parallel
#pragma omp single
    emptySpace.copy(root, &result, rootBounds);
    return result;
}

}  // namespace bwfirt
