// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/ObjectSplit.h"

namespace bwfirt::wide {

CentreCounts::CentreCounts(const CentreBins& bins) : bins_(bins) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::fill_n(boxes_[axis].begin(), bins.count(), Box::empty());
        std::fill_n(counts_[axis].begin(), bins.count(), 0);
    }
}

void CentreCounts::count(std::span<const Reference> references) {
    for (const Reference& reference : references) {
        const Int4 bin = bins_.of(reference);
        const Box box = reference.box();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(bin[axis]);
            boxes_[axis][i].extend(box);
            ++counts_[axis][i];
        }
    }
}

void CentreCounts::add(const CentreCounts& other) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < bins_.count(); ++i) {
            boxes_[axis][i].extend(other.boxes_[axis][i]);
            counts_[axis][i] += other.counts_[axis][i];
        }
}

ObjectSplit CentreCounts::bestSplit(float scale) const {
    const std::size_t binCount = bins_.count();
    ObjectSplit best;
    Box bestBelow = Box::empty(), bestAbove = Box::empty();
    for (int axis = 0; axis < 3; ++axis) {
        if (!bins_.areTold(axis))
            continue;
        const auto& box = boxes_[static_cast<std::size_t>(axis)];
        const auto& number = counts_[static_cast<std::size_t>(axis)];
        std::array<Box, MOST_BINS> above;
        std::array<float, MOST_BINS> costAbove;
        Box sum = Box::empty();
        std::uint32_t sumNumber = 0;
        for (std::size_t i = binCount - 1; i > 0; --i) {
            sum.extend(box[i]);
            sumNumber += number[i];
            above[i] = sum;
            costAbove[i] =
                sumNumber == 0 ? INFINITE : static_cast<float>(sumNumber) * sum.halfArea(scale);
        }
        sum = Box::empty();
        sumNumber = 0;
        for (std::size_t i = 1; i < binCount; ++i) {
            sum.extend(box[i - 1]);
            sumNumber += number[i - 1];
            if (sumNumber == 0)
                continue;
            const float cost = static_cast<float>(sumNumber) * sum.halfArea(scale) + costAbove[i];
            if (cost < best.cost) {
                best = {cost, axis, static_cast<int>(i), 0};
                bestBelow = sum;
                bestAbove = above[i];
            }
        }
    }
    bestBelow.intersect(bestAbove);
    best.overlap = bestBelow.isEmpty() ? 0 : bestBelow.halfArea();
    return best;
}

}  // namespace bwfirt::wide
