// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace bwfirt {

/// Four triangles side by side, to be tested together. Copying them in the order in which they are
/// tested also saves the cache from fetching each of them from elsewhere.
class Triangle4 {
  public:
    static constexpr std::size_t SIZE = 4;

    /// @param indices of one to four triangles; the last one fills what is left
    Triangle4(std::span<const Triangle> triangles, std::span<const std::uint32_t> indices) {
        for (std::size_t i = 0; i < SIZE; ++i) {
            indices_[i] = indices[std::min(i, indices.size() - 1)];
            for (std::size_t vertex = 0; vertex < 3; ++vertex)
                for (int axis = 0; axis < 3; ++axis)
                    coordinates_[vertex][static_cast<std::size_t>(axis)][i] =
                        triangles[indices_[i]].vertices[vertex][axis];
        }
    }

    Doubles4 coordinates(std::size_t vertex, int axis) const {
        return Doubles4(coordinates_[vertex][static_cast<std::size_t>(axis)].data(),
                        std::experimental::element_aligned);
    }
    std::uint32_t index(int i) const { return indices_[static_cast<std::size_t>(i)]; }

  private:
    std::array<std::array<std::array<float, SIZE>, 3>, 3> coordinates_;  ///< by vertex and axis
    std::array<std::uint32_t, SIZE> indices_;
};

}  // namespace bwfirt
