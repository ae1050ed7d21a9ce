// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/SceneBoxes.h"

#include <algorithm>
#include <limits>

namespace bwfirt {

using Imath::Box3d;

Box3d spaceOf(const Box3d& bounds) {
    constexpr double FLAT = 1e-3, ROOM = 0.5;  // of the largest extent
    constexpr double LARGEST = std::numeric_limits<float>::max();
    const V3d size = bounds.size();
    const double largest = std::max({size.x, size.y, size.z});
    const double extent = largest > 0 ? largest : 1;
    Box3d space = bounds;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > FLAT * extent)
            continue;
        space.min[axis] = std::max(space.min[axis] - ROOM * extent, -LARGEST);
        space.max[axis] = std::min(space.max[axis] + ROOM * extent, LARGEST);
    }
    return space;
}

Box3d detailsOf(const Scene& scene, const Box3d& bounds) {
    constexpr std::size_t SAMPLES = 10000;
    constexpr std::size_t OUTLIERS = 20;  // one vertex in so many at either end of each axis
    const std::size_t step = scene.triangles.size() / SAMPLES + 1;
    std::vector<V3f> vertices;
    for (std::size_t i = 0; i < scene.triangles.size(); i += step)
        if (const Triangle& triangle = scene.triangles[i]; isFinite(triangle))
            vertices.insert(vertices.end(), triangle.vertices.begin(), triangle.vertices.end());
    Box3d details = bounds;
    for (int axis = 0; axis < 3 && !vertices.empty(); ++axis) {
        std::sort(vertices.begin(), vertices.end(),
                  [axis](const V3f& a, const V3f& b) { return a[axis] < b[axis]; });
        const std::size_t outliers = vertices.size() / OUTLIERS;
        details.min[axis] = vertices[outliers][axis];
        details.max[axis] = vertices[vertices.size() - 1 - outliers][axis];
    }
    return details;
}

Box3d surroundingsOf(const Box3d& box, const Box3d& limits) {
    const V3d size = box.size();
    const double margin = std::max({size.x, size.y, size.z});
    Box3d result;
    for (int axis = 0; axis < 3; ++axis) {
        result.min[axis] = std::max(limits.min[axis], box.min[axis] - margin);
        result.max[axis] = std::min(limits.max[axis], box.max[axis] + margin);
    }
    return result;
}

}  // namespace bwfirt
