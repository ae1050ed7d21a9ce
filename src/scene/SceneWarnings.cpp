// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Scene.h"
#include "scene/TextReader.h"

#include <algorithm>
#include <cmath>

namespace bwfirt {

std::vector<std::string> sceneWarnings(const Scene& scene) {
    // Beyond this, 1e-4, by which rays start above the surface, is less than 13 steps of float32.
    constexpr float LARGEST_COORDINATE = 128;

    std::size_t notFinite = 0;
    float largest = 0;
    for (const Triangle& triangle : scene.triangles) {
        if (!isFinite(triangle)) {
            ++notFinite;
            continue;
        }
        for (const V3f& vertex : triangle.vertices)
            largest =
                std::max({largest, std::abs(vertex.x), std::abs(vertex.y), std::abs(vertex.z)});
    }

    std::vector<std::string> warnings;
    if (notFinite > 0)
        warnings.push_back(std::to_string(notFinite) +
                           " triangles have an infinite or NaN coordinate and are never hit");
    if (largest > LARGEST_COORDINATE)
        warnings.push_back("the largest coordinate is " + formatNumber(largest) +
                           ": beyond 128 the offset of rays from surfaces drowns in single "
                           "precision; scale the scene down");
    return warnings;
}

}  // namespace bwfirt
