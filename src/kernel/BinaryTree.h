// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bwfirt::binary {

/// An axis-aligned box.
struct Bounds {
    V3f low;
    V3f high;

    bool operator==(const Bounds&) const = default;
};

/// A node of a binary tree. An inner node has its children side by side.
struct BinaryNode {
    Bounds bounds;
    std::uint32_t first;  ///< inner node: its first child; leaf: its first entry in references
    std::uint32_t count;  ///< inner node: 0; leaf: number of entries
};
static_assert(sizeof(BinaryNode) == 32);

/// A KernelAllocator of cache lines that leaves new numbers unset: large arrays are first touched
/// by the threads that fill them.
template <typename T>
struct UnsetAllocator : KernelAllocator<T> {
    using value_type = T;
    template <typename U>
    struct rebind {
        using other = UnsetAllocator<U>;
    };

    UnsetAllocator() = default;
    template <typename U>
    UnsetAllocator(const UnsetAllocator<U>&) noexcept {}

    T* allocate(std::size_t count) {
        struct alignas(64) CacheLine {
            std::array<std::byte, 64> bytes;
        };
        constexpr std::size_t SIZE = sizeof(CacheLine);
        const std::size_t lines = count / SIZE * sizeof(T) + count % SIZE * sizeof(T) / SIZE + 1;
        return reinterpret_cast<T*>(KernelAllocator<CacheLine>().allocate(lines));
    }
    template <typename U>
    void construct(U*) noexcept {}
};
template <typename T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// A binary tree over triangles. Each triangle stands in one leaf or, where it was split, in
/// several, whose boxes together hold all of it. Not all elements of the arrays are in use.
struct BinaryTree {
    /// Longest way from the root to a leaf, before reinsertion.
    static constexpr int MAX_DEPTH = 96;

    UnsetVector<BinaryNode> nodes;          ///< the root first; none for a scene without area
    UnsetVector<std::uint32_t> parents;     ///< of the nodes 2 i and 2 i + 1
    UnsetVector<std::uint32_t> references;  ///< indices of triangles

    /// Whether test(triangle) is true for all references below a node; asks no further than to the
    /// first for which it is not.
    template <typename Test>
    bool allBelow(std::uint32_t index, const Test& test) const {
        const BinaryNode& node = nodes[index];
        if (node.count == 0)
            return allBelow(node.first, test) && allBelow(node.first + 1, test);
        for (std::uint32_t i = 0; i < node.count; ++i)
            if (!test(references[node.first + i]))
                return false;
        return true;
    }
};

}  // namespace bwfirt::binary
