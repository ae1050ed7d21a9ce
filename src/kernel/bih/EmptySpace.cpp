// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/EmptySpace.h"

#include <array>
#include <limits>
#include <vector>

namespace bwfirt {

namespace {

class EmptySpace {
  public:
    /// A node to be copied.
    struct Part {
        const Node* source;
        Node* target;
        Box interval;  ///< what a ray knows of the bounds on its way down
    };

    EmptySpace(const NodePairs& sources, const Box* bounds, NodePairs& targets)
        : sources_(sources), bounds_(bounds), targets_(targets) {}

    /// Copies nodes with long lists one after the other, and then side by side what is below them.
    void copy(const Part& root, std::size_t longLists) {
        const auto isLong = [=](const Part& part) {
            return !part.source->isLeaf() && part.source->children() < longLists;
        };
        std::vector<Part> top{root};
        for (std::size_t i = 0; i < top.size(); ++i)
            if (isLong(top[i]))
                for (const Part& child : copyInner(top[i]))
                    top.push_back(child);
#pragma omp parallel for schedule(dynamic)
        for (const Part& part : top)
            if (!isLong(part))
                copy(part);
    }

  private:
    void copy(const Part& part) {
        if (part.source->isLeaf())
            *part.target = *part.source;
        else
            for (const Part& child : copyInner(part))
                copy(child);
    }

    /// @return what is to be copied below
    std::array<Part, 2> copyInner(Part part) {
        const Node& source = *part.source;
        Node* const target = cutOff(part.target, bounds_[source.children()], part.interval);
        Box first = part.interval, second = part.interval;
        first.high[static_cast<int>(source.axis())] = source.firstHigh();
        second.low[static_cast<int>(source.axis())] = source.secondLow();
        const std::uint32_t place = targets_.take();
        *target = Node::inner(source.axis(), source.firstHigh(), source.secondLow(), place);
        const NodePair& from = sources_[source.children()];
        NodePair& to = targets_[place];
        return {Part{&from[0], &to[0], first}, Part{&from[1], &to[1], second}};
    }

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
                      std::size_t longLists, const Box* bounds, NodePairs& target) {
    Node result;
    EmptySpace(source, bounds, target).copy({&root, &result, rootBounds}, longLists);
    return result;
}

}  // namespace bwfirt
