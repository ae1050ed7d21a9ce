// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>

namespace bwfirt {

/// How often a kernel was asked.
struct RayCounts {
    std::uint64_t intersect = 0;   ///< h
    std::uint64_t visibility = 0;  ///< V

    RayCounts& operator+=(const RayCounts& other) {
        intersect += other.intersect;
        visibility += other.visibility;
        return *this;
    }
};

}  // namespace bwfirt
