// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"
#include "kernel/bih/NodePairs.h"

namespace bwfirt {

/// The two planes of a node bound each child on one side only. Copies a tree; where much of the
/// interval of an inner node is empty, a node in front of it cuts that off, with an empty leaf.
/// @param longLists the children of nodes with long lists of triangles have places below this
/// @param bounds of inner nodes, by the place of their children
/// @return the root of the copy
Node cutOffEmptySpace(const Node& root, const Box& rootBounds, const NodePairs& source,
                      std::size_t longLists, const Box* bounds, NodePairs& target);

}  // namespace bwfirt
