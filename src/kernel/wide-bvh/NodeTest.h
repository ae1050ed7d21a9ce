// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/RayConstants.h"
#include "kernel/wide-bvh/WideTree.h"

namespace bwfirt::wide {

/// Where a ray enters and leaves the boxes of a node's children; it meets those that it does not
/// leave before it enters them.
struct NodeSpans {
    Floats enter, leave;
};

/// The slab test, for all children at once.
inline NodeSpans spansOf(const Node& node, const RayConstants& ray, float tMax) {
    const float* const planes = node.planes.front().data();
    const auto enter = [&](std::size_t axis) {
        return multiplySubtract(load(planes + ray.nearPlane[axis]), all(ray.inverse[axis]),
                                all(ray.nearOffset[axis]));
    };
    const auto leave = [&](std::size_t axis) {
        return multiplySubtract(load(planes + ray.farPlane[axis]), all(ray.inverse[axis]),
                                all(ray.farOffset[axis]));
    };
    // A NaN, which only coordinates near the end of the range bring about, excludes nothing.
    return {greater(greater(enter(0), enter(1)), greater(enter(2), all(0))),
            lesser(lesser(leave(0), leave(1)), lesser(leave(2), all(tMax)))};
}

/// Which children's boxes a ray meets, and where it enters them.
struct NodeMeeting {
    Floats t;
    Mask children;
};

inline NodeMeeting meet(const Node& node, const RayConstants& ray, float tMax) {
    const NodeSpans spans = spansOf(node, ray, tMax);
    return {spans.enter, isLessOrEqual(spans.enter, spans.leave)};
}

}  // namespace bwfirt::wide
