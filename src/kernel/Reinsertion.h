// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/BinaryTree.h"

namespace bwfirt::binary {

/// Share of the root's area that a node must have for its children to be moved.
inline constexpr float MUCH_AREA = 2e-4F;

/// Lowers the cost of a tree by the surface area heuristic: takes subtrees out and puts each back
/// where it makes the boxes grow least. Meister, Bittner: "Parallel reinsertion for bounding volume
/// hierarchy optimization", Computer Graphics Forum 37(2), 2018.
void reinsert(BinaryTree& tree, int passes);

}  // namespace bwfirt::binary
