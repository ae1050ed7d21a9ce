// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/qbvh/Node.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace bwfirt {

void Node::setBoxes(std::span<const Box> boxes, double scale) {
    constexpr float INFINITE = std::numeric_limits<float>::infinity();
    constexpr int HIGHEST_PLANE = 65535;
    Box all;
    for (const Box& box : boxes)
        all.extend(box);
    leavesAndExponents = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const auto low = [&](const Box& box) {
            return scale * static_cast<double>(box.low[axis]) - MARGIN;
        };
        const auto high = [&](const Box& box) {
            return scale * static_cast<double>(box.high[axis]) + MARGIN;
        };
        origin[i] = std::nextafter(static_cast<float>(low(all)), -INFINITE);
        const int exponent = std::ilogb((high(all) - origin[i]) / HIGHEST_PLANE) + 1;
        leavesAndExponents |= static_cast<std::uint32_t>(exponent + 127) << (8 * (axis + 1));
        const double step = std::ldexp(1.0, exponent);
        for (std::size_t child = 0; child < WIDTH; ++child) {
            if (child >= boxes.size()) {
                planes[2 * i][child] = HIGHEST_PLANE;
                planes[2 * i + 1][child] = 0;
                continue;
            }
            const double first = std::floor((low(boxes[child]) - origin[i]) / step);
            const double last = std::ceil((high(boxes[child]) - origin[i]) / step);
            assert(first >= 0 && last <= HIGHEST_PLANE);
            planes[2 * i][child] = static_cast<std::uint16_t>(first);
            planes[2 * i + 1][child] = static_cast<std::uint16_t>(last);
        }
    }
}

}  // namespace bwfirt
