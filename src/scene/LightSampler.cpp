// SPDX-License-Identifier: GPL-3.0-only
#include "scene/LightSampler.h"

#include <algorithm>
#include <numbers>

namespace bwfirt {

LightSampler::LightSampler(const Scene& scene) : lights_(scene.lights) {
    double power = 0;
    for (const Light& light : scene.lights) {
        if (light.exitance == 0)
            continue;
        for (std::uint32_t i = light.first; i <= light.last; ++i) {
            const Triangle& triangle = scene.triangles[i];
            if (!hasArea(triangle))
                continue;
            power += area(triangle) * light.exitance;
            const V3d a(triangle.vertices[0]), b(triangle.vertices[1]), c(triangle.vertices[2]);
            powers_.push_back(power);
            emitters_.push_back({a, b - a, c - b, unitNormal(triangle),
                                 light.exitance / std::numbers::pi, light.exitance});
        }
    }
    for (Emitter& emitter : emitters_)
        emitter.pdfArea /= power;
    std::sort(lights_.begin(), lights_.end(),
              [](const Light& a, const Light& b) { return a.first < b.first; });
}

double LightSampler::radiance(std::uint32_t triangle) const {
    const auto next = std::upper_bound(
        lights_.begin(), lights_.end(), triangle,
        [](std::uint32_t index, const Light& light) { return index < light.first; });
    if (next == lights_.begin())
        return 0;
    const Light& light = *std::prev(next);
    return triangle <= light.last ? light.exitance / std::numbers::pi : 0;
}

}  // namespace bwfirt
