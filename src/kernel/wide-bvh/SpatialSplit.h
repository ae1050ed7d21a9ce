// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/Reference.h"

#include <array>
#include <span>

namespace bwfirt::wide {

/// Divides a node into slabs of equal thickness along each axis.
class Slabs {
  public:
    static constexpr int COUNT = 16;

    explicit Slabs(const Box& node) : quarterLow_(0.25f * node.low), low_(node.low) {
        for (int axis = 0; axis < 3; ++axis) {
            const float quarter = 0.25f * node.high[axis] - quarterLow_[axis];
            const float steps = COUNT * 0.9999f / quarter;
            steps_[axis] = std::isfinite(steps) ? steps : 0;
            thickness_[axis] = node.length(axis) / (COUNT * 0.9999);
        }
        steps_[3] = steps_[0];
    }

    bool areTold(int axis) const { return steps_[axis] > 0; }  ///< whether there is any distance

    /// The slabs, along each axis, of a point in the node.
    Int4 of(const Float4& point) const {
        return __builtin_convertvector((0.25f * point - quarterLow_) * steps_, Int4);
    }
    /// The plane below a slab.
    Plane plane(int axis, int slab) const {
        return {axis, static_cast<float>(low_[axis] + slab * thickness_[axis])};
    }

  private:
    Float4 quarterLow_;
    Float4 steps_;
    Float4 low_;
    std::array<double, 3> thickness_;
};

/// References divided by the plane below a slab; those that reach over it are cut.
struct SpatialSplit {
    float cost = INFINITE;  ///< number times half area of both sides, in the scale of the node
    int axis = 0;
    int slab = 0;
    std::uint32_t below = 0;  ///< number of references
    std::uint32_t above = 0;
};

/// What the slabs hold: Stich, Friedrich, Dietrich: "Spatial splits in bounding volume
/// hierarchies", High Performance Graphics 2009.
class SlabCounts {
  public:
    SlabCounts(const Slabs& slabs, std::span<const Triangle> triangles);
    void count(std::span<const Reference> references);
    void add(const SlabCounts& other);

    /// The split of least cost by the surface area heuristic, of those that leave no more than
    /// `mostReferences` in both sides together.
    SpatialSplit bestSplit(float scale, std::size_t mostReferences) const;

  private:
    void chop(const Reference& reference, int axis, int first, int last);

    Slabs slabs_;
    std::span<const Triangle> triangles_;
    std::array<std::array<Box, Slabs::COUNT>, 3> boxes_;
    std::array<std::array<std::uint32_t, Slabs::COUNT>, 3> entries_{};  ///< references that begin
    std::array<std::array<std::uint32_t, Slabs::COUNT>, 3> exits_{};    ///< and that end there
};

}  // namespace bwfirt::wide
