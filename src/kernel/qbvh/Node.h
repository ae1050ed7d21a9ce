// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"
#include "kernel/qbvh/Vectors.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace bwfirt {

/// Where a leaf begins among all leaves, and its number of triangles, in 32 bits.
class LeafAddress {
  public:
    static constexpr std::uint32_t MOST_TRIANGLES = 8;
    /// What the 29 bits for the beginning can tell apart.
    static constexpr std::size_t MOST_ADDRESSES = std::size_t{1} << 29;

    LeafAddress(std::uint32_t first, std::uint32_t count) : bits_(first << 3 | (count - 1)) {}
    explicit LeafAddress(std::uint32_t bits) : bits_(bits) {}

    std::uint32_t bits() const { return bits_; }
    std::uint32_t first() const { return bits_ >> 3; }  ///< number of triangles before the leaf
    std::uint32_t count() const { return (bits_ & 7) + 1; }

  private:
    std::uint32_t bits_;
};

/// A node: its four children, whose boxes stand on a grid of 65536 planes an axis (Dammertz,
/// Hanika, Keller: "Shallow bounding volume hierarchies for fast SIMD ray tracing of incoherent
/// rays", EGSR 2008, for the four; Mahovsky, Wyvill: "Memory-conserving bounding volume hierarchies
/// with coherent raytracing", Computer Graphics Forum 25(2), 2006, for the grid).
struct alignas(16) Node {
    static constexpr std::size_t WIDTH = 4;
    /// Each box is larger than its triangles by at least this on all sides, in coordinates of the
    /// tree, in which the scene reaches from -1 to 1.
    static constexpr double MARGIN = 0x1p-20;

    std::array<float, 3> origin;  ///< of the grid
    /// From the lowest on: a bit for each child that is a leaf, in eight bits, and in as many each
    /// the exponents of the grid's steps, powers of 2, plus 127.
    std::uint32_t leavesAndExponents;
    /// By 2 * axis + (0 for low, 1 for high), and by child: position in steps from the origin.
    std::array<std::array<std::uint16_t, WIDTH>, 6> planes;
    std::array<std::uint32_t, WIDTH> children;  ///< index of a node, or bits of a LeafAddress

    /// Encloses the boxes of one to four children, multiplied by `scale`, none of which is a leaf
    /// yet. A box that is not there is one that no ray meets.
    void setBoxes(std::span<const Box> boxes, double scale);
    bool hasBox(std::size_t child) const { return planes[0][child] <= planes[1][child]; }

    void setNode(std::size_t child, std::uint32_t index) { children[child] = index; }
    void setLeaf(std::size_t child, LeafAddress address) {
        children[child] = address.bits();
        leavesAndExponents |= 1U << child;
    }
    Int4 allChildren() const { return std::bit_cast<Int4>(children); }
    unsigned leaves() const { return leavesAndExponents & ((1U << WIDTH) - 1); }
    bool isLeaf(std::size_t child) const { return (leaves() >> child & 1) != 0; }
    LeafAddress leaf(std::size_t child) const { return LeafAddress(children[child]); }

    /// The grid's origin, and any number.
    Float4 gridOrigin() const {
        Float4 result;
        std::memcpy(&result, this, sizeof result);
        return result;
    }
    /// Any number, and the grid's steps.
    Float4 gridSteps() const { return powersOf2(leavesAndExponents); }
};
static_assert(sizeof(Node) == 80);

}  // namespace bwfirt
