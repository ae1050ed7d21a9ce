// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/Simd.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace bwfirt::wide {

/// Once a hit is found: leaves those children on a stack, in their order, that the ray enters at
/// tMax or before, so that none of the others has to be asked about when it is taken. Both arrays
/// have room for WIDTH more numbers than their size.
/// @param enters where the ray enters the children's boxes
/// @return how many are left
inline std::uint32_t dropBeyond(float tMax, std::uint32_t* children, float* enters,
                                std::uint32_t size) {
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < size; i += WIDTH) {
        const Floats enter = load(enters + i);
        const auto here = std::min<std::uint32_t>(size - i, WIDTH);
        const Mask isMet = isLessOrEqual(enter, all(tMax)) & ((Mask{1} << here) - 1);
        storeChosen(children + kept, isMet, load(children + i));
        storeChosen(enters + kept, isMet, enter);
        kept += static_cast<std::uint32_t>(std::popcount(isMet));
    }
    return kept;
}

}  // namespace bwfirt::wide
