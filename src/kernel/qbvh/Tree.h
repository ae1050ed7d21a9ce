// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "kernel/qbvh/Node.h"

#include <memory>

namespace bwfirt {

struct KernelFree {
    void operator()(void* pointer) const { RTKernel::kernel_free(pointer); }
};

/// An array of kernel memory that is not initialised, so that the thread that needs a part first
/// fetches it from the system.
template <typename T>
using Array = std::unique_ptr<T[], KernelFree>;

template <typename T>
Array<T> makeArray(std::size_t size) {
    return Array<T>(static_cast<T*>(RTKernel::kernel_malloc(size * sizeof(T), alignof(T))));
}

/// A tree over triangles.
struct Tree {
    /// Longest way from the root to a leaf.
    static constexpr int MAX_SAH_DEPTH = 48;
    static constexpr int MAX_DEPTH = MAX_SAH_DEPTH + 32;

    Array<Node> nodes;             ///< the root first; none for a scene without area
    Array<std::uint32_t> indices;  ///< of triangles, in the order of the leaves
    double scale = 1;              ///< from the scene's coordinates to those of the nodes
};

Tree buildTree(std::span<const Triangle> triangles);

}  // namespace bwfirt
