// SPDX-License-Identifier: GPL-3.0-only
#include "film/ColourMap.h"

#include <algorithm>
#include <array>

namespace bwfirt {

V3d viridis(double value) {
    static const std::array<V3d, 9> STEPS = {
        V3d(0.058, 0.000, 0.089), V3d(0.063, 0.025, 0.188), V3d(0.045, 0.084, 0.254),
        V3d(0.025, 0.156, 0.270), V3d(0.014, 0.279, 0.262), V3d(0.019, 0.428, 0.213),
        V3d(0.111, 0.584, 0.126), V3d(0.402, 0.706, 0.034), V3d(0.984, 0.799, 0.018)};
    const double position = std::clamp(value, 0.0, 1.0) * (STEPS.size() - 1);
    const std::size_t step = std::min(static_cast<std::size_t>(position), STEPS.size() - 2);
    const double fraction = position - static_cast<double>(step);
    return (1 - fraction) * STEPS[step] + fraction * STEPS[step + 1];
}

}  // namespace bwfirt
