// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"

#include <algorithm>
#include <cstdint>

namespace bwfirt {

/// A regular grid of cubes over a box. They are numbered along the Morton curve: the bits of a
/// number tell in which half of the grid the cell is along x, y and z, then in which half of that
/// half, and so on.
class Grid {
  public:
    /// @param axisBits up to 16; there are 2^axisBits cells along an axis
    Grid(const Box& box, int axisBits)
        : halfLow_(0.5F * box.low), last_(static_cast<float>((1 << axisBits) - 1)) {
        const Floats4 half = 0.5F * box.high - halfLow_;
        scale_ = (last_ + 1) / std::max({float(half[0]), float(half[1]), float(half[2])});
    }

    /// The cell around a point. Where that overflows or is not a number, it is any cell.
    std::uint64_t cellAround(const Floats4& point) const {
        const Floats4 position = (0.5F * point - halfLow_) * scale_;
        const auto place = static_simd_cast<Ints4>(min(max(position, Floats4(0)), last_));
        return spread(place[0]) << 2 | spread(place[1]) << 1 | spread(place[2]);
    }

    /// The axis along which a bit of the number tells the half.
    static int axisOf(int bit) { return 2 - bit % 3; }

  private:
    using Ints4 = std::experimental::rebind_simd_t<int, Floats4>;

    /// Puts two zeros in front of each of 16 bits.
    static std::uint64_t spread(int place) {
        auto x = static_cast<std::uint64_t>(place);
        x = (x | x << 16) & 0x0000'FF00'00FF;
        x = (x | x << 8) & 0x00F0'0F00'F00F;
        x = (x | x << 4) & 0x0C30'C30C'30C3;
        x = (x | x << 2) & 0x2492'4924'9249;
        return x;
    }

    Floats4 halfLow_;
    Floats4 last_;
    Floats4 scale_;
};

}  // namespace bwfirt
