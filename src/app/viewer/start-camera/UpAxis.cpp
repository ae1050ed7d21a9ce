// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/UpAxis.h"

#include <algorithm>

namespace bwfirt {

namespace {

/// Squared cosine between the axis and a normal that counts for it: 11 degrees off at most.
constexpr double ALIGNED = 0.96;
/// Weight of a surface in the lower half of the scene, where one in the upper half has 1.
constexpr double LOW_WEIGHT = 2;
/// What z must be ahead of y, as a part of the whole surface: more than chance gives to round
/// objects, which have little surface that is perpendicular to an axis.
constexpr double MARGIN = 0.02;
/// By how many times x must exceed y and z: nobody has it upwards on purpose.
constexpr double X_FACTOR = 3;

}  // namespace

int upAxis(const Scene& scene) {
    const V3d centre = boundsOf(scene).center();
    V3d flat(0);
    double whole = 0;
    for (const Triangle& triangle : scene.triangles) {
        if (!isFinite(triangle))
            continue;
        const V3d normal = edgeCross(triangle);
        const double square = normal.dot(normal), size = std::sqrt(square);
        whole += size;
        for (int axis = 0; axis < 3; ++axis) {
            const bool isLow = triangle.vertices[0][axis] < centre[axis];
            if (normal[axis] * normal[axis] > ALIGNED * square)
                flat[axis] += isLow ? LOW_WEIGHT * size : size;
        }
    }
    const double margin = MARGIN * whole;
    if (flat.x > X_FACTOR * std::max(flat.y, flat.z) + margin)
        return 0;
    return flat.z > flat.y + margin ? 2 : 1;
}

}  // namespace bwfirt
