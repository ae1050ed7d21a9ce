// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bwfirt {

/// A node in twelve bytes. An inner node says where its first child ends and where its second child
/// begins, along one axis. The two may overlap, or leave a gap.
class Node {
  public:
    /// What the 30 bits for the children's place can tell apart.
    static constexpr std::size_t MOST_PAIRS = std::size_t{1} << 30;

    static Node leaf(std::uint32_t first, std::uint32_t count) {
        Node node;
        node.first_ = first;
        node.bits_ = count << 2 | LEAF;
        return node;
    }

    static Node inner(std::size_t axis, float firstHigh, float secondLow, std::uint32_t children) {
        Node node;
        node.clip_ = {firstHigh, secondLow};
        node.bits_ = children << 2 | static_cast<std::uint32_t>(axis);
        return node;
    }

    bool isLeaf() const { return (bits_ & 3) == LEAF; }
    std::size_t axis() const { return bits_ & 3; }
    float firstHigh() const { return clip_[0]; }
    float secondLow() const { return clip_[1]; }
    std::uint32_t children() const { return bits_ >> 2; }
    std::uint32_t first() const { return first_; }
    std::uint32_t count() const { return bits_ >> 2; }

  private:
    static constexpr std::uint32_t LEAF = 3;

    union {
        std::array<float, 2> clip_;  ///< inner node: the first child's end, the second's begin
        std::uint32_t first_;        ///< leaf: where its triangles begin in Tree::order
    };
    std::uint32_t bits_;  ///< axis or LEAF in the lower two, place of the children or count above
};
static_assert(sizeof(Node) == 12);

}  // namespace bwfirt
