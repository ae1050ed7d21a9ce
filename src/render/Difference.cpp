// SPDX-License-Identifier: GPL-3.0-only
#include "render/Difference.h"

#include <algorithm>
#include <cmath>

namespace bwfirt {

std::optional<Difference> differenceOf(const std::optional<Hit>& right,
                                       const std::optional<Hit>& answer) {
    if (!right || !answer) {
        if (right)
            return Difference::MISSED;
        return answer ? std::optional(Difference::GHOST) : std::nullopt;
    }
    if (right->triangle == answer->triangle)
        return std::nullopt;
    constexpr double TIE_DISTANCE = 1e-5;
    const double a = right->distance, b = answer->distance;
    return std::abs(a - b) <= TIE_DISTANCE * std::max(a, b) ? Difference::TIE
                                                            : Difference::WRONG_TRIANGLE;
}

std::optional<Difference> differenceOf(bool right, bool answer) {
    if (right == answer)
        return std::nullopt;
    return answer ? Difference::FALSE_VISIBLE : Difference::FALSE_OCCLUDED;
}

}  // namespace bwfirt
