// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/KernelArray.h"
#include "kernel/wide-bvh/Simd.h"

#include <array>
#include <bit>
#include <cstring>

namespace bwfirt::wide {

/// What the processor fetches from memory at a time. Nodes and leaves begin at a line.
struct alignas(64) Line {
    std::array<std::byte, 64> bytes;
};

/// A child of a node: where its node or leaf stands.
class Child {
  public:
    static constexpr std::uint32_t LEAF = 0x80000000;
    static constexpr std::size_t MOST_LINES = LEAF;

    static bool isLeaf(std::uint32_t child) { return child >= LEAF; }
    static std::size_t line(std::uint32_t child) { return child & ~LEAF; }
};

/// The boxes of up to WIDTH children, plane by plane: the low ones along x, y, z, then the high
/// ones. Where there is no child, the box is empty, and the child a leaf without triangles: a ray
/// whose numbers overflow may go there.
struct alignas(64) Node {
    std::array<std::array<float, WIDTH>, 6> planes;
    std::array<std::uint32_t, WIDTH> children;

    /// For each octant of directions a permutation of the children, that which such a ray is likely
    /// to meet last in front (the scheme of Fuetterling et al.: "Accelerated single ray tracing for
    /// wide vector units", HPG 2017). Of the number of each lane the octant's bits begin at
    /// shift(octant).
    std::array<std::uint32_t, WIDTH> order;

    static constexpr std::uint32_t shift(std::uint32_t octant) {
        return octant * std::bit_width(static_cast<std::uint32_t>(WIDTH - 1));
    }
};

/// A few triangles, which share vertices. Behind the counts stand the vertices, coordinate by
/// coordinate, then the triangles' indices, then for each corner of the triangles its vertex.
class Leaf {
  public:
    /// Of triangles, and of vertices that differ.
    static constexpr std::uint32_t MOST = WIDTH;

    static std::size_t bytes(std::size_t triangles, std::size_t vertices) {
        return HEADER + vertices * sizeof(V3f) + triangles * (sizeof(std::uint32_t) + 3);
    }

    explicit Leaf(const Line* lines)
        : bytes_(reinterpret_cast<const std::uint8_t*>(lines)),
          triangles_(bytes_[0]),
          vertices_(bytes_[1]) {}

    Mask triangles() const { return (Mask{1} << triangles_) - 1; }

    /// Of all vertices along an axis; what stands behind them fills the rest.
    Floats coordinates(int axis) const { return load(row(axis)); }

    /// For each triangle, which vertex its first, second or third corner is.
    Ints vertexOf(std::size_t corner) const { return loadBytes(corners() + corner * triangles_); }

    std::uint32_t index(std::size_t triangle) const {
        std::uint32_t index;
        std::memcpy(&index, indices() + triangle * sizeof index, sizeof index);
        return index;
    }

    Triangle triangle(std::size_t triangle) const {
        Triangle result;
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                result.vertices[corner][axis] =
                    row(axis)[corners()[corner * triangles_ + triangle]];
        return result;
    }

  private:
    friend class LeafWriter;
    static constexpr std::size_t HEADER = 4;

    const float* row(int axis) const {
        return reinterpret_cast<const float*>(bytes_ + HEADER) +
               static_cast<std::size_t>(axis) * vertices_;
    }
    const std::uint8_t* indices() const { return bytes_ + HEADER + vertices_ * sizeof(V3f); }
    const std::uint8_t* corners() const { return indices() + triangles_ * sizeof(std::uint32_t); }

    const std::uint8_t* bytes_;
    std::size_t triangles_, vertices_;
};

/// Nodes and leaves in one piece of memory, the root first. What is below a node stands behind it.
class WideTree {
  public:
    /// Behind the tree stands a leaf without triangles. It is long enough for what is read beyond
    /// the end of other leaves.
    static constexpr std::size_t END_LINES = 4;

    /// Longest way from the root to a leaf, in nodes.
    static constexpr std::size_t MOST_DEPTH = 97;

    /// Where the root stands.
    static constexpr std::uint32_t ROOT = 0;

    /// No node at all where no triangle can be hit.
    explicit WideTree(std::span<const Triangle> triangles);
    WideTree() = default;

    bool isEmpty() const { return lines_ == nullptr; }
    const Node& node(std::uint32_t child) const {
        return *reinterpret_cast<const Node*>(&lines_[child]);
    }
    /// Fetches the lines behind the first, too: only the first tells where in them the rest stands.
    Leaf leaf(std::uint32_t child) const {
        const Line* const first = &lines_[Child::line(child)];
        __builtin_prefetch(first + 1);
        __builtin_prefetch(first + 2);
        return Leaf(first);
    }

    /// A child that no node has. Something stands there, so that it may be fetched.
    std::uint32_t end() const { return end_; }

    void prefetch(std::uint32_t child) const {
        const Line* const first = &lines_[Child::line(child)];
        const std::size_t count = Child::isLeaf(child) ? 3 : sizeof(Node) / sizeof(Line);
        for (std::size_t i = 0; i < count; ++i)
            __builtin_prefetch(first + i);
    }

    /// Fetches as much as a node takes, whatever stands there: there is no branch that a processor
    /// may guess wrongly.
    void prefetchAny(std::uint32_t child) const {
        const Line* const first = &lines_[Child::line(child)];
        for (std::size_t i = 0; i < sizeof(Node) / sizeof(Line); ++i)
            __builtin_prefetch(first + i);
    }

    /// The largest coordinate, up to its sign.
    float reach() const { return reach_; }

  private:
    /// False where reinsertion has made the binary tree too deep.
    bool build(std::span<const Triangle> triangles, int reinsertions);

    KernelArray<Line> lines_;
    std::uint32_t end_ = 0;
    float reach_ = 0;
};

}  // namespace bwfirt::wide
