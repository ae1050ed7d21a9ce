// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

#include <array>

namespace bwfirt {

/// In what way a kernel's answer differs from the right one.
enum class Difference {
    MISSED,          ///< h: a hit is right, the kernel has none
    GHOST,           ///< h: none is right, the kernel has a hit
    WRONG_TRIANGLE,  ///< h: another triangle at another distance
    TIE,             ///< h: another triangle at the same distance, relative 1e-5; no error
    FALSE_VISIBLE,   ///< V: hidden is right
    FALSE_OCCLUDED,  ///< V: visible is right
};
constexpr std::array<const char*, 6> DIFFERENCE_NAMES = {
    "missed", "ghost", "wrong_triangle", "tie", "false_visible", "false_occluded"};

/// Nothing where the answers agree.
std::optional<Difference> differenceOf(const std::optional<Hit>& right,
                                       const std::optional<Hit>& answer);
std::optional<Difference> differenceOf(bool right, bool answer);

}  // namespace bwfirt
