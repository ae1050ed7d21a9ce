// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/qbvh/Node.h"
#include "kernel/qbvh/Vectors.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace bwfirt {

/// The grid on which the vertices of a leaf's triangles stand: the leaf's box in 255 steps an axis,
/// in coordinates of the tree. Fourth lanes stay unused.
struct LeafGrid {
    Float4 origin;
    Float4 step;

    [[gnu::always_inline]] LeafGrid(const Node& node, std::size_t child) {
        const auto& planes = node.planes;
        const Int4 low{planes[0][child], planes[2][child], planes[4][child], 0};
        const Int4 high{planes[1][child], planes[3][child], planes[5][child], 0};
        const Float4 steps = node.gridSteps();
        const Float4 nodeStep = __builtin_shufflevector(steps, steps, 1, 2, 3, 0);
        origin = node.gridOrigin() + __builtin_convertvector(low, Float4) * nodeStep;
        step = __builtin_convertvector(high - low, Float4) * (1.0F / 255) * nodeStep;
    }
};

/// One to eight triangles in 13 bytes each: a row of bytes, one for each triangle, for every
/// coordinate of every vertex, then the triangles' indices.
class Leaf {
  public:
    static constexpr std::size_t ROWS = 9;
    static constexpr std::size_t BYTES_PER_TRIANGLE = ROWS + sizeof(std::uint32_t);
    /// A row is read as eight bytes, which may reach beyond the last leaf.
    static constexpr std::size_t BYTES_BEHIND = 8;

    Leaf(const std::uint8_t* leaves, LeafAddress address)
        : bytes_(leaves + address.first() * BYTES_PER_TRIANGLE), count_(address.count()) {}

    std::size_t count() const { return count_; }
    const std::uint8_t* row(std::size_t axis, std::size_t vertex) const {
        return bytes_ + (3 * axis + vertex) * count_;
    }
    std::uint32_t triangle(std::size_t i) const {
        std::uint32_t index;
        std::memcpy(&index, bytes_ + ROWS * count_ + i * sizeof index, sizeof index);
        return index;
    }
    void prefetch() const {
        __builtin_prefetch(bytes_);
        __builtin_prefetch(bytes_ + 64);
    }

    /// Writes a triangle whose vertices are in the grid's box, its coordinates multiplied by
    /// `scale`.
    static void write(std::uint8_t* leaves, LeafAddress address, std::size_t i,
                      const LeafGrid& grid, std::uint32_t index, const Triangle& triangle,
                      double scale) {
        std::uint8_t* const bytes = leaves + address.first() * BYTES_PER_TRIANGLE;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            for (std::size_t vertex = 0; vertex < 3; ++vertex) {
                const double coordinate = scale * static_cast<double>(triangle.vertices[vertex][a]);
                const double steps = std::round((coordinate - static_cast<double>(grid.origin[a])) /
                                                static_cast<double>(grid.step[a]));
                bytes[(3 * axis + vertex) * address.count() + i] =
                    static_cast<std::uint8_t>(std::clamp(steps, 0.0, 255.0));
            }
        }
        std::memcpy(bytes + ROWS * address.count() + i * sizeof index, &index, sizeof index);
    }

  private:
    const std::uint8_t* bytes_;
    std::size_t count_;
};

}  // namespace bwfirt
