// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace bwfirt::wide {

// Keys of which each is a number's bits, with its lane in the lowest of them: see Simd.h.

constexpr std::int32_t LANE_BITS = 15;
constexpr std::int32_t NO_KEY = 0x7fffffff;

inline std::size_t laneOf(std::int32_t key) {
    return static_cast<std::size_t>(key & LANE_BITS);
}
inline bool isBeyond(std::int32_t key, float x) {
    return key > std::bit_cast<std::int32_t>(x);
}

}  // namespace bwfirt::wide
