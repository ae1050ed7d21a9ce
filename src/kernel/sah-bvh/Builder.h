// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/sah-bvh/Arena.h"
#include "kernel/sah-bvh/Node.h"

#include <span>

namespace bwfirt {

/// Longest way from the root to a leaf.
constexpr int MAX_DEPTH = 64;

/// Builds a bounding volume hierarchy over the triangles, in the arena. The tree is the same for
/// any number of threads. @return its root, null where no triangle has area
const Node* buildBvh(std::span<const Triangle> triangles, Arena& arena);

}  // namespace bwfirt
