// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/Reinsertion.h"

#include "kernel/BinaryBox.h"

#include <algorithm>
#include <array>
#include <vector>

namespace bwfirt::binary {

namespace {

/// A subtree, a node that may become its sibling, and by how much that lowers the sum of all areas.
struct Move {
    std::uint32_t node;
    std::uint32_t sibling;
    float gain;
};

class Reinserter {
  public:
    explicit Reinserter(BinaryTree& tree)
        : nodes_(tree.nodes),
          parents_(tree.parents),
          isTaken_(tree.nodes.size()),
          scale_(Box::of(nodes_[0]).scale()) {}

    void run(int passes) {
        for (int i = 0; i < passes; ++i) {
            moves_.clear();
            collect(0, MUCH_AREA * areaOf(0));
#pragma omp parallel for schedule(dynamic, 64)
            for (Move& move : moves_)
                move = bestMove(move.node);
            std::erase_if(moves_, [](const Move& move) { return !(move.gain > 0); });
            std::sort(moves_.begin(), moves_.end(), [](const Move& a, const Move& b) {
                return a.gain != b.gain ? a.gain > b.gain : a.node < b.node;
            });
            for (const Move& move : moves_)
                if (isPossible(move))
                    apply(move);
            for (const std::uint32_t node : taken_)
                isTaken_[node] = 0;
            taken_.clear();
        }
    }

  private:
    /// Nodes that are looked at for the sake of one subtree; many only where boxes overlap much.
    static constexpr int MOST_VISITS = 512;
    static constexpr std::size_t STACK_SIZE = 2 * BinaryTree::MAX_DEPTH;

    bool isLeaf(std::uint32_t node) const {
        return nodes_[node].count > 0;
    }
    Box boxOf(std::uint32_t node) const {
        return Box::of(nodes_[node]);
    }
    float areaOf(std::uint32_t node) const {
        return boxOf(node).halfArea(scale_);
    }
    std::uint32_t parentOf(std::uint32_t node) const {
        return parents_[node / 2];
    }
    static std::uint32_t siblingOf(std::uint32_t node) {
        return node ^ 1;
    }

    /// Makes children of large nodes, but not those of the root, candidates.
    void collect(std::uint32_t node, float leastArea) {
        if (isLeaf(node) || areaOf(node) < leastArea)
            return;
        for (const std::uint32_t child : {nodes_[node].first, nodes_[node].first + 1}) {
            if (node != 0)
                moves_.push_back({child, 0, 0});
            collect(child, leastArea);
        }
    }

    /// Looks in the subtrees beside the way from the node to the root.
    Move bestMove(std::uint32_t node) const {
        Move best{node, 0, 0};
        int visits = 0;
        const Box box = boxOf(node);
        std::uint32_t pivot = parentOf(node);
        float gain = areaOf(pivot);  // without the node, before it grows other boxes
        Box remaining = boxOf(siblingOf(node));
        search(siblingOf(node), gain, box, best, visits);
        while (pivot != 0) {
            search(siblingOf(pivot), gain, box, best, visits);
            remaining.extend(boxOf(siblingOf(pivot)));
            pivot = parentOf(pivot);
            gain += areaOf(pivot) - remaining.halfArea(scale_);
        }
        return best;
    }

    /// Looks in a subtree for the best sibling.
    /// @param gain what is won before the boxes of the subtree grow
    void search(std::uint32_t root, float gain, const Box& box, Move& best, int& visits) const {
        struct Entry {
            std::uint32_t node;
            float gain;
        };
        const float leastCost = box.halfArea(scale_);
        std::array<Entry, STACK_SIZE> stack;
        std::size_t size = 0;
        stack[size++] = {root, gain};
        while (size > 0 && ++visits <= MOST_VISITS) {
            const Entry entry = stack[--size];
            if (entry.gain - leastCost <= best.gain)
                continue;
            Box merged = boxOf(entry.node);
            const float area = merged.halfArea(scale_);
            merged.extend(box);
            const float gainHere = entry.gain - merged.halfArea(scale_);
            if (gainHere > best.gain && entry.node != siblingOf(best.node))
                best = {best.node, entry.node, gainHere};
            const float gainBelow = gainHere + area;
            if (isLeaf(entry.node) || gainBelow - leastCost <= best.gain || size + 2 > stack.size())
                continue;
            stack[size++] = {nodes_[entry.node].first, gainBelow};
            stack[size++] = {nodes_[entry.node].first + 1, gainBelow};
        }
    }

    /// False where an earlier move has changed the surroundings of the nodes.
    bool isPossible(const Move& move) {
        const std::uint32_t parent = parentOf(move.node);
        const std::array nodes{move.node,        siblingOf(move.node), parent,
                               parentOf(parent), move.sibling,         parentOf(move.sibling)};
        const auto isTaken = [&](std::uint32_t node) { return isTaken_[node] != 0; };
        if (std::any_of(nodes.begin(), nodes.end(), isTaken) || isWithin(move.sibling, move.node))
            return false;
        for (const std::uint32_t node : nodes) {
            isTaken_[node] = 1;
            taken_.push_back(node);
        }
        return true;
    }
    bool isWithin(std::uint32_t node, std::uint32_t subtree) const {
        while (node != subtree && node != 0)
            node = parentOf(node);
        return node == subtree;
    }

    /// Puts the old sibling in the place of the parent, the new one in the place of the old one,
    /// and a new parent in the place of the new one.
    void apply(const Move& move) {
        const std::uint32_t oldSibling = siblingOf(move.node), oldParent = parentOf(move.node);
        place(nodes_[oldSibling], oldParent);
        place(nodes_[move.sibling], oldSibling);
        nodes_[move.sibling] = {{}, std::min(move.node, oldSibling), 0};
        parents_[move.node / 2] = move.sibling;
        refit(parentOf(oldParent));
        refit(move.sibling);
    }
    void place(const BinaryNode& node, std::uint32_t index) {
        nodes_[index] = node;
        if (node.count == 0)
            parents_[node.first / 2] = index;
    }
    /// Adapts the boxes from an inner node up to the root.
    void refit(std::uint32_t node) {
        while (true) {
            Box box = boxOf(nodes_[node].first);
            box.extend(boxOf(nodes_[node].first + 1));
            const Bounds bounds = box.bounds();
            if (node == 0 || bounds == nodes_[node].bounds)
                break;
            nodes_[node].bounds = bounds;
            node = parentOf(node);
        }
    }

    UnsetVector<BinaryNode>& nodes_;
    UnsetVector<std::uint32_t>& parents_;
    KernelVector<Move> moves_;
    KernelVector<std::uint8_t> isTaken_;  ///< whether a move has changed the node's links
    KernelVector<std::uint32_t> taken_;   ///< those nodes
    float scale_;
};

}  // namespace

void reinsert(BinaryTree& tree, int passes) {
    if (tree.nodes[0].count == 0)
        Reinserter(tree).run(passes);
}

}  // namespace bwfirt::binary
