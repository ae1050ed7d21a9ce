// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bwfirt::wide {

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
};

struct BinaryTreeSettings {
    /// Bound on the number of references, per triangle.
    double mostReferences = 1.3;
    /// Passes that improve the tree by reinsertion.
    int reinsertions = 3;
};

/// Builds the tree with all threads of OpenMP. The result does not depend on their number.
BinaryTree buildBinaryTree(std::span<const Triangle> triangles,
                           const BinaryTreeSettings& settings = {});

}  // namespace bwfirt::wide
