// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/LeafContent.h"

#include <algorithm>

namespace bwfirt::wide {

bool LeafContent::collect(std::span<const Triangle> triangles, const BinaryTree& tree,
                          std::uint32_t node) {
    triangleCount_ = vertexCount_ = 0;
    const auto addNext = [&](std::uint32_t index) { return add(triangles[index], index); };
    return tree.allBelow(node, addNext);
}

bool LeafContent::add(const Triangle& triangle, std::uint32_t index) {
    const auto* const end = indices_.data() + triangleCount_;
    if (std::find(static_cast<const std::uint32_t*>(indices_.data()), end, index) != end)
        return true;
    if (triangleCount_ == Leaf::MOST)
        return false;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint8_t vertex = vertexOf(triangle.vertices[corner]);
        if (vertex == Leaf::MOST)
            return false;
        corners_[corner][triangleCount_] = vertex;
    }
    indices_[triangleCount_++] = index;
    return true;
}

std::uint8_t LeafContent::vertexOf(const V3f& point) {
    std::size_t i = 0;
    while (i < vertexCount_ && std::memcmp(&vertices_[i], &point, sizeof point) != 0)
        ++i;
    if (i == vertexCount_ && i < Leaf::MOST)
        vertices_[vertexCount_++] = point;
    return static_cast<std::uint8_t>(i);
}

void LeafContent::write(Line* target) const {
    std::byte* next = target->bytes.data();
    const auto append = [&](const void* data, std::size_t bytes) {
        std::memcpy(next, data, bytes);
        next += bytes;
    };
    const std::array<std::uint8_t, 4> header = {static_cast<std::uint8_t>(triangleCount_),
                                                static_cast<std::uint8_t>(vertexCount_)};
    append(header.data(), header.size());
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < vertexCount_; ++i)
            append(&vertices_[i][axis], sizeof(float));
    append(indices_.data(), triangleCount_ * sizeof(std::uint32_t));
    for (const auto& ofCorner : corners_)
        append(ofCorner.data(), triangleCount_);
}

}  // namespace bwfirt::wide
