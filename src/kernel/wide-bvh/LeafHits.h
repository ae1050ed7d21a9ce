// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"
#include "kernel/wide-bvh/LeafTest.h"

#include <bit>
#include <limits>

namespace bwfirt::wide {

/// The nearest hit of a ray among the triangles tested so far.
class NearestHit {
  public:
    /// Beyond this nothing is looked for.
    float tMax() const { return tMax_; }

    std::optional<Hit> hit() const {
        return isHit_ ? std::optional<Hit>({static_cast<float>(t_), triangle_}) : std::nullopt;
    }

    /// Tests triangles of a leaf in double precision. Of several at the same distance that of the
    /// least index is kept, so that the order in which leaves are tested does not matter.
    /// @return whether one of them is nearer than what there was
    bool test(const Ray& ray, const Leaf& leaf, Mask triangles) {
        const float before = tMax_;
        for (; triangles != 0; triangles &= triangles - 1) {
            const WatertightRay exact(V3d(ray.origin), V3d(ray.direction));
            const auto triangle = static_cast<std::size_t>(std::countr_zero(triangles));
            const std::optional<double> t = exact.intersect(leaf.triangle(triangle));
            if (!t || !(*t <= t_) || !(static_cast<float>(*t) > 0))
                continue;
            const std::uint32_t index = leaf.index(triangle);
            triangle_ = *t < t_ ? index : std::min(index, triangle_);
            t_ = *t;
            tMax_ = static_cast<float>(*t);
            isHit_ = true;
        }
        return tMax_ < before;
    }

  private:
    float tMax_ = std::numeric_limits<float>::max();
    bool isHit_ = false;
    std::uint32_t triangle_ = 0;
    double t_ = std::numeric_limits<float>::max();
};

/// Whether one of these triangles of a leaf blocks the segment, in double precision.
[[gnu::noinline]] inline bool isBlockedBy(const Leaf& leaf, Mask triangles,
                                          const RTKernel::Segment& segment) {
    const WatertightRay exact(V3d(segment.x), V3d(segment.y) - V3d(segment.x));
    for (; triangles != 0; triangles &= triangles - 1) {
        const auto triangle = static_cast<std::size_t>(std::countr_zero(triangles));
        const std::optional<double> t = exact.intersect(leaf.triangle(triangle));
        if (t && *t < 1)
            return true;
    }
    return false;
}

/// Whether any triangle of the leaf blocks the segment. Single precision leaves that open for few.
inline bool isBlockedBy(const Leaf& leaf, const RayConstants& constants,
                        const RTKernel::Segment& segment) {
    const LeafMeeting meeting = meet(leaf, constants, 1);
    if (meeting.certain != 0)
        return true;
    return meeting.possible != 0 && isBlockedBy(leaf, meeting.possible, segment);
}

}  // namespace bwfirt::wide
