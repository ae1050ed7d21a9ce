// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace bwfirt {

/// The kernel that this executable is linked with. The build writes the definition.
struct KernelInfo {
    static const char* const NAME;   ///< of its folder
    static const char* const FLAGS;  ///< that it was compiled with

    /// How many rays in a million at a closed mesh may pass through it, as the README in that
    /// folder promises: rays aimed at the interiors, the edges and the vertices of triangles.
    static const double MISSES_AT_INTERIORS;
    static const double MISSES_AT_EDGES;
    static const double MISSES_AT_VERTICES;
};

}  // namespace bwfirt
