// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/SensorResponse.h"

#include "render/PathTracer.h"
#include "render/Renderer.h"

#include <algorithm>
#include <cmath>

namespace bwfirt {

double fittingSensorResponse(const Scene& scene, const RTKernel& kernel, const Camera& camera) {
    constexpr int WIDTH = 16, HEIGHT = 12, PASSES = 5;
    constexpr double MEDIUM = 0.25;  // shown as 137 of 255
    if (scene.lights.empty())
        return 1;
    const PathTracer pathTracer(scene, kernel, camera, WIDTH, HEIGHT, 1);
    Film film(WIDTH, HEIGHT);
    for (int pass = 0; pass < PASSES; ++pass)
        Renderer(pathTracer, 1, 1).renderPass(film);

    std::vector<double> lit;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            if (const double mean = film.mean(x, y).x; mean > 0)
                lit.push_back(mean);
    if (lit.empty())
        return 1;
    const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::nth_element(lit.begin(), middle, lit.end());
    return std::exp2(std::round(std::log2(camera.sensorResponse * MEDIUM / *middle)));
}

}  // namespace bwfirt
