// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/SpatialSplit.h"

namespace bwfirt::wide {

SlabCounts::SlabCounts(const Slabs& slabs, std::span<const Triangle> triangles)
    : slabs_(slabs), triangles_(triangles) {
    for (auto& boxesOfAxis : boxes_)
        boxesOfAxis.fill(Box::empty());
}

void SlabCounts::count(std::span<const Reference> references) {
    for (const Reference& reference : references) {
        const Box box = reference.box();
        const Int4 first = slabs_.of(box.low), last = slabs_.of(box.high);
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            ++entries_[i][static_cast<std::size_t>(first[axis])];
            ++exits_[i][static_cast<std::size_t>(last[axis])];
            if (first[axis] == last[axis])
                boxes_[i][static_cast<std::size_t>(first[axis])].extend(box);
            else
                chop(reference, axis, first[axis], last[axis]);
        }
    }
}

/// Extends the boxes of slabs first to last by what of the triangle lies in them: the hull of its
/// sections with the planes below and above the slab, and the vertices in it.
void SlabCounts::chop(const Reference& reference, int axis, int first, int last) {
    const Triangle& triangle = triangles_[reference.triangle()];
    std::array<Float4, 3> v;  // in the order of their positions along the axis
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = toFloat4(triangle.vertices[i]);
    const auto sort = [&](Float4& a, Float4& b) {
        if (b[axis] < a[axis])
            std::swap(a, b);
    };
    sort(v[0], v[1]);
    sort(v[1], v[2]);
    sort(v[0], v[1]);
    const float middle = v[1][axis];
    const Float4 edge = (v[2] - v[0]) / (v[2][axis] - v[0][axis]);
    const Float4 edgeBelow = (v[1] - v[0]) / (middle - v[0][axis]);
    const Float4 edgeAbove = (v[2] - v[1]) / (v[2][axis] - middle);

    const Box box = reference.box();
    Box* part = &boxes_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(first)];
    Box section{v[0], v[0]};
    float before = -INFINITE;
    for (int slab = first; slab <= last; ++slab, ++part) {
        Box clipped = section;
        const float position = slab < last ? slabs_.plane(axis, slab + 1).position : INFINITE;
        if (slab < last) {
            section = Box::empty();
            section.extend(v[0] + (position - v[0][axis]) * edge);
            section.extend(position < middle ? v[0] + (position - v[0][axis]) * edgeBelow
                                             : v[1] + (position - middle) * edgeAbove);
            clipped.extend(section);
        } else {
            clipped.extend(v[2]);
        }
        if (before <= middle && middle < position)
            clipped.extend(v[1]);
        before = position;
        clipped.intersect(box);
        if (!clipped.isEmpty())
            part->extend(clipped);
    }
}

void SlabCounts::add(const SlabCounts& other) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < Slabs::COUNT; ++i) {
            boxes_[axis][i].extend(other.boxes_[axis][i]);
            entries_[axis][i] += other.entries_[axis][i];
            exits_[axis][i] += other.exits_[axis][i];
        }
}

SpatialSplit SlabCounts::bestSplit(float scale, std::size_t mostReferences) const {
    SpatialSplit best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!slabs_.areTold(axis))
            continue;
        const auto i = static_cast<std::size_t>(axis);
        std::array<float, Slabs::COUNT> areaAbove;
        std::array<std::uint32_t, Slabs::COUNT> numberAbove;
        Box sum = Box::empty();
        std::uint32_t number = 0;
        for (std::size_t slab = Slabs::COUNT - 1; slab > 0; --slab) {
            sum.extend(boxes_[i][slab]);
            number += exits_[i][slab];
            areaAbove[slab] = sum.halfArea(scale);
            numberAbove[slab] = number;
        }
        sum = Box::empty();
        number = 0;
        for (std::size_t slab = 1; slab < Slabs::COUNT; ++slab) {
            sum.extend(boxes_[i][slab - 1]);
            number += entries_[i][slab - 1];
            if (number == 0 || numberAbove[slab] == 0 ||
                std::size_t{number} + numberAbove[slab] > mostReferences)
                continue;
            const float cost = static_cast<float>(number) * sum.halfArea(scale) +
                               static_cast<float>(numberAbove[slab]) * areaAbove[slab];
            if (cost < best.cost)
                best = {cost, axis, static_cast<int>(slab), number, numberAbove[slab]};
        }
    }
    return best;
}

}  // namespace bwfirt::wide
