// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bwfirt {

/// What a node refers to: another node, or a leaf, which is a few entries of the index list.
class Child {
  public:
    static constexpr std::uint32_t LARGEST_LEAF = 4;
    /// What the 29 bits for the first entry of a leaf can tell apart.
    static constexpr std::size_t MOST_ENTRIES = std::size_t{1} << 29;

    static Child node(std::uint32_t index) { return Child(index << 3); }
    static Child leaf(std::uint32_t first, std::uint32_t count) {
        return Child(first << 3 | count);
    }

    bool isLeaf() const { return count() != 0; }
    std::uint32_t nodeIndex() const { return bits_ >> 3; }
    std::uint32_t first() const { return bits_ >> 3; }
    std::uint32_t count() const { return bits_ & 7; }

    Child() = default;

  private:
    explicit Child(std::uint32_t bits) : bits_(bits) {}

    std::uint32_t bits_;
};

/// A node in one cache line: its four children, whose boxes stand on a grid of 256 planes an axis
/// (Dammertz, Hanika, Keller: "Shallow bounding volume hierarchies for fast SIMD ray tracing of
/// incoherent rays", EGSR 2008, for the four; Mahovsky, Wyvill: "Memory-conserving bounding volume
/// hierarchies with coherent raytracing", Computer Graphics Forum 25(2), 2006, for the grid).
struct alignas(64) Node {
    static constexpr std::size_t WIDTH = 4;
    /// The grid's steps are no smaller, where the largest coordinate of the scene is 0.5 to 1.
    static constexpr double LEAST_STEP = 0x1p-60;
    /// Each box is larger than its triangles by at least this part of a step on all sides.
    static constexpr double MARGIN = 0x1p-10;

    std::array<float, 3> origin;  ///< of the grid
    std::array<float, 3> step;
    /// By 2 * axis + (0 for low, 1 for high), and by child: position in steps from the origin.
    std::array<std::array<std::uint8_t, WIDTH>, 6> planes;
    std::array<Child, WIDTH> children;

    /// Encloses the boxes of one to four children, multiplied by `scale`. A box that is not there
    /// is one that no ray meets.
    void setBoxes(std::span<const Bounds> boxes, double scale);
};
static_assert(sizeof(Node) == 64);

}  // namespace bwfirt
