// SPDX-License-Identifier: GPL-3.0-only
#include "render/FalseColour.h"

#include "film/ColourMap.h"
#include "math/Random.h"

#include <chrono>
#include <cmath>

namespace bwfirt {

namespace {

constexpr double MOST_QUERIES = 32;

}  // namespace

FalseColour::FalseColour(View view, const Scene& scene, const RTKernel& kernel,
                         const Camera& camera, int width, int height, double sceneDiagonal)
    : view_(view),
      scene_(scene),
      kernel_(kernel),
      cameraRays_(camera, width, height),
      sceneDiagonal_(sceneDiagonal) {
    if (view == View::QUERIES)
        pathTracer_.emplace(scene, kernel, camera, width, height, 1);
}

void FalseColour::trace(std::span<Sample> samples, RayCounts& counts) const {
    for (Sample& sample : samples) {
        if (view_ == View::QUERIES) {
            RayCounts asked;
            pathTracer_->trace({&sample, 1}, asked);
            sample.value =
                viridis(static_cast<double>(asked.intersect + asked.visibility) / MOST_QUERIES);
            counts += asked;
            continue;
        }
        Random random(sample.seed);
        const auto [u, v] = random.uniformSquare();
        const Ray ray = cameraRays_.through(sample.x + u, sample.y + v);
        if (view_ == View::TIME) {
            sample.value = V3d(secondsOfIntersection(ray));
            ++counts.intersect;
            continue;
        }
        const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
        ++counts.intersect;
        sample.value = hit ? colourOf(ray, *hit) : V3d(0);
    }
}

double FalseColour::secondsOfIntersection(const Ray& ray) const {
    const auto start = std::chrono::steady_clock::now();
    kernel_.kernelIntersectGeometry(ray);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

V3d FalseColour::colourOf(const Ray& ray, const Hit& hit) const {
    if (view_ == View::DISTANCE)
        return viridis(hit.distance / sceneDiagonal_);
    if (view_ == View::TRIANGLES) {
        Random random(hit.triangle);
        const double red = random.uniform(), green = random.uniform(), blue = random.uniform();
        return {red, green, blue};
    }
    const V3d direction(ray.direction);
    const V3d normal = unitAgainst(direction, edgeCross(scene_.triangles[hit.triangle]));
    if (view_ == View::EVEN_LIGHT)
        return V3d(scene_.reflectance * -normal.dot(direction));
    return (normal + V3d(1)) / 2;
}

}  // namespace bwfirt
