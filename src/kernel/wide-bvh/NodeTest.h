// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/RayConstants.h"
#include "kernel/wide-bvh/WideTree.h"

namespace bwfirt::wide {

/// Which children's boxes a ray meets, and where it enters them.
struct NodeMeeting {
    Floats t;
    Mask children;
};

/// The slab test, for all children at once.
inline NodeMeeting meet(const Node& node, const RayConstants& ray, float tMax) {
    const auto enter = [&](std::size_t axis) {
        return multiplySubtract(load(node.planes[ray.nearPlane[axis]].data()),
                                all(ray.inverse[axis]), all(ray.nearOffset[axis]));
    };
    const auto leave = [&](std::size_t axis) {
        return multiplySubtract(load(node.planes[ray.farPlane[axis]].data()),
                                all(ray.inverse[axis]), all(ray.farOffset[axis]));
    };
    // A NaN, which only coordinates near the end of the range bring about, excludes nothing.
    const Floats t = greater(greater(enter(0), enter(1)), greater(enter(2), all(0)));
    const Floats end = lesser(lesser(leave(0), leave(1)), lesser(leave(2), all(tMax)));
    return {t, isLessOrEqual(t, end)};
}

}  // namespace bwfirt::wide
