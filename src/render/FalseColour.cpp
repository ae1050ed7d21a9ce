// SPDX-License-Identifier: GPL-3.0-only
#include "render/FalseColour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bwfirt {

namespace {

constexpr double MOST_QUERIES = 32;

/// The length of the diagonal of the box around all finite triangles.
double diagonal(const Scene& scene) {
    V3d low(0), high(0);
    bool isFirst = true;
    for (const Triangle& triangle : scene.triangles) {
        if (!isFinite(triangle))
            continue;
        for (const V3f& vertex : triangle.vertices) {
            if (isFirst)
                low = high = V3d(vertex);
            isFirst = false;
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min<double>(low[axis], vertex[axis]);
                high[axis] = std::max<double>(high[axis], vertex[axis]);
            }
        }
    }
    return std::sqrt((high - low).dot(high - low));
}

/// The colour map viridis, in nine steps of linear RGB: it rises evenly in lightness, so that it
/// survives grey printing and colour blindness.
V3d viridis(double value) {
    static const std::array<V3d, 9> STEPS = {
        V3d(0.058, 0.000, 0.089), V3d(0.063, 0.025, 0.188), V3d(0.045, 0.084, 0.254),
        V3d(0.025, 0.156, 0.270), V3d(0.014, 0.279, 0.262), V3d(0.019, 0.428, 0.213),
        V3d(0.111, 0.584, 0.126), V3d(0.402, 0.706, 0.034), V3d(0.984, 0.799, 0.018)};
    const double position = std::clamp(value, 0.0, 1.0) * (STEPS.size() - 1);
    const std::size_t step = std::min(static_cast<std::size_t>(position), STEPS.size() - 2);
    const double fraction = position - static_cast<double>(step);
    return (1 - fraction) * STEPS[step] + fraction * STEPS[step + 1];
}

}  // namespace

FalseColour::FalseColour(View view, const Scene& scene, const RTKernel& kernel,
                         const Camera& camera, int width, int height)
    : view_(view),
      scene_(scene),
      kernel_(kernel),
      cameraRays_(camera, width, height),
      pathTracer_(scene, kernel, camera, width, height, 1),
      sceneDiagonal_(diagonal(scene)) {}

void FalseColour::trace(std::span<Sample> samples, RayCounts& counts) const {
    for (Sample& sample : samples) {
        if (view_ == View::QUERIES) {
            RayCounts asked;
            pathTracer_.trace({&sample, 1}, asked);
            sample.value =
                viridis(static_cast<double>(asked.intersect + asked.visibility) / MOST_QUERIES);
            counts += asked;
            continue;
        }
        Random random(sample.seed);
        const auto [u, v] = random.uniformSquare();
        const Ray ray = cameraRays_.through(sample.x + u, sample.y + v);
        const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
        ++counts.intersect;
        sample.value = hit ? colourOf(ray, *hit) : V3d(0);
    }
}

V3d FalseColour::colourOf(const Ray& ray, const Hit& hit) const {
    if (view_ == View::DISTANCE)
        return viridis(hit.distance / sceneDiagonal_);
    if (view_ == View::TRIANGLES) {
        Random random(hit.triangle);
        const double red = random.uniform(), green = random.uniform(), blue = random.uniform();
        return {red, green, blue};
    }
    const V3d normal = unitNormal(scene_.triangles[hit.triangle]);
    return (flippedAgainst(V3d(ray.direction), normal) + V3d(1)) / 2;
}

}  // namespace bwfirt
