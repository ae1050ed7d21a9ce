// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/qbvh/Node.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace bwfirt {

void Node::setBoxes(std::span<const Bounds> boxes, double scale) {
    constexpr float INFINITE = std::numeric_limits<float>::infinity();
    constexpr double HIGHEST_PLANE = 255;
    Bounds all;
    for (const Bounds& box : boxes)
        all.extend(box);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = scale * static_cast<double>(all.low[axis]);
        const double high = scale * static_cast<double>(all.high[axis]);
        // The origin lies below `low` by more than the margin, and the highest plane above `high`.
        const double room = std::max((high - low) * 0x1p-16, LEAST_STEP * 2 * MARGIN);
        origin[i] = std::nextafter(static_cast<float>(low - room), -INFINITE);
        step[i] =
            std::nextafter(static_cast<float>(std::max(
                               (high - origin[i]) / (HIGHEST_PLANE - 2 * MARGIN), LEAST_STEP)),
                           INFINITE);
        for (std::size_t child = 0; child < WIDTH; ++child) {
            if (child >= boxes.size()) {
                planes[2 * i][child] = 255;
                planes[2 * i + 1][child] = 0;
                continue;
            }
            const auto toSteps = [&](float position) {
                return (scale * static_cast<double>(position) - origin[i]) / step[i];
            };
            const double first = std::floor(toSteps(boxes[child].low[axis]) - MARGIN);
            const double last = std::ceil(toSteps(boxes[child].high[axis]) + MARGIN);
            assert(first >= 0 && last <= HIGHEST_PLANE);
            planes[2 * i][child] = static_cast<std::uint8_t>(first);
            planes[2 * i + 1][child] = static_cast<std::uint8_t>(last);
        }
    }
}

}  // namespace bwfirt
