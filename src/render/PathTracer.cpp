// SPDX-License-Identifier: GPL-3.0-only
#include "render/PathTracer.h"

#include "math/Sampling.h"

#include <array>
#include <memory>
#include <numbers>
#include <vector>

namespace bwfirt {

PathTracer::PathTracer(const Scene& scene, const RTKernel& kernel, const Camera& camera, int width,
                       int height, int inFlight)
    : scene_(scene),
      kernel_(kernel),
      lights_(scene),
      cameraRays_(camera, width, height),
      sensorResponse_(camera.sensorResponse),
      brdf_(scene.reflectance / std::numbers::pi),
      inFlight_(static_cast<std::size_t>(inFlight)) {}

void PathTracer::trace(std::span<Sample> samples, RayCounts& counts) const {
    if (inFlight_ == 1)
        traceOneByOne(samples, counts);
    else
        traceInFlight(samples, counts);
}

PathTracer::Path PathTracer::begin(Sample& sample) const {
    Path path{&sample, Random(sample.seed), {}, 0, 0, true, {}, {}, 0};
    const auto [u, v] = path.random.uniformSquare();
    path.ray = cameraRays_.through(sample.x + u, sample.y + v);
    return path;
}

void PathTracer::arrive(Path& path, const std::optional<Hit>& hit) const {
    path.contribution = 0;
    path.goesOn = false;
    if (!hit)
        return;
    const V3d direction(path.ray.direction);
    const V3d normal = unitNormalAgainst(direction, scene_.triangles[hit->triangle]);
    if (path.bounce == 0)
        path.radiance += lights_.radiance(hit->triangle);

    const V3d hitPoint = V3d(path.ray.origin) + static_cast<double>(hit->distance) * direction;
    const V3d x = hitPoint + RTKernel::NORMAL_OFFSET * normal;
    path.x = V3f(x);
    const LightSample light = lights_.sample(path.random);
    scatter(path, normal);
    connect(path, x, normal, light);
}

void PathTracer::scatter(Path& path, const V3d& normal) const {
    path.goesOn = path.random.uniform() < scene_.reflectance;
    if (path.goesOn)
        path.ray = {path.x, V3f(sampleCosineHemisphere(normal, path.random))};
}

void PathTracer::connect(Path& path, const V3d& x, const V3d& normal,
                         const LightSample& light) const {
    const double side = std::copysign(1.0, -light.normal.dot(light.point - x));
    const V3d y = light.point + side * RTKernel::NORMAL_OFFSET * light.normal;
    path.y = V3f(y);

    const V3d d = y - x;
    const double cosX = normal.dot(d), cosY = -side * light.normal.dot(d);  // times |d|
    if (cosX > 0 && cosY > 0) {
        const double distanceSquared = d.dot(d);
        path.contribution = brdf_ * light.radiance * cosX * cosY /
                            (distanceSquared * distanceSquared * light.pdfArea);
    }
}

void PathTracer::end(const Path& path) const {
    path.sample->value = V3d(sensorResponse_ * path.radiance);
}

template <typename Intersect, typename IsVisible>
void PathTracer::follow(Sample& sample, const Intersect& intersect,
                        const IsVisible& isVisible) const {
    Path path = begin(sample);
    for (; path.goesOn; ++path.bounce) {
        arrive(path, intersect(path));
        if (path.contribution > 0 && isVisible(path))
            path.radiance += path.contribution;
    }
    end(path);
}

// Flattened, the steps of a path hand it to each other in registers, which saves an eighth of the
// framework's time (build/framework-cost).
[[gnu::flatten]] void PathTracer::traceOneByOne(std::span<Sample> samples,
                                                RayCounts& counts) const {
    for (Sample& sample : samples) {
        follow(
            sample,
            [&](const Path& path) {
                ++counts.intersect;
                return kernel_.kernelIntersectGeometry(path.ray);
            },
            [&](const Path& path) {
                ++counts.visibility;
                return kernel_.kernelVisibility(path.x, path.y);
            });
    }
}

void PathTracer::trace(std::span<Sample> samples, RayCounts& counts, RayListener& listener) const {
    for (Sample& sample : samples) {
        follow(
            sample,
            [&](const Path& path) {
                ++counts.intersect;
                const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(path.ray);
                listener.intersected(path.ray, path.bounce, hit);
                return hit;
            },
            [&](const Path& path) {
                ++counts.visibility;
                const bool isVisible = kernel_.kernelVisibility(path.x, path.y);
                listener.connected(path.x, path.y, path.bounce, isVisible);
                return isVisible;
            });
    }
}

void PathTracer::traceInFlight(std::span<Sample> samples, RayCounts& counts) const {
    std::vector<Path> paths;
    std::vector<Ray> rays(inFlight_);
    std::vector<std::optional<Hit>> hits(inFlight_);
    std::vector<RTKernel::Segment> segments(inFlight_);
    std::vector<std::size_t> connected(inFlight_);
    const auto visible = std::make_unique<bool[]>(inFlight_);
    paths.reserve(inFlight_);

    std::size_t begun = 0;
    while (true) {
        while (paths.size() < inFlight_ && begun < samples.size())
            paths.push_back(begin(samples[begun++]));
        if (paths.empty())
            return;

        for (std::size_t i = 0; i < paths.size(); ++i)
            rays[i] = paths[i].ray;
        kernel_.kernelIntersectMany({rays.data(), paths.size()}, {hits.data(), paths.size()});
        counts.intersect += paths.size();

        std::size_t connections = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            arrive(paths[i], hits[i]);
            if (paths[i].contribution > 0) {
                connected[connections] = i;
                segments[connections++] = {paths[i].x, paths[i].y};
            }
        }

        kernel_.kernelVisibleMany({segments.data(), connections}, {visible.get(), connections});
        counts.visibility += connections;
        for (std::size_t i = 0; i < connections; ++i) {
            Path& path = paths[connected[i]];
            if (visible[i])
                path.radiance += path.contribution;
        }

        std::erase_if(paths, [&](Path& path) {
            ++path.bounce;
            if (!path.goesOn)
                end(path);
            return !path.goesOn;
        });
    }
}

}  // namespace bwfirt
