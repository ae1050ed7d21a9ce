// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"

namespace bwfirt::wide {

using namespace binary;

/// Builds a binary tree with spatial splits, with all threads of OpenMP. The result does not depend
/// on their number.
/// @param mostReferences bound on the number of references, per triangle
BinaryTree buildBinaryTree(std::span<const Triangle> triangles, double mostReferences = 1.3);

}  // namespace bwfirt::wide
