// SPDX-License-Identifier: GPL-3.0-only
#include "render/PathTracer.h"

#include "math/Sampling.h"

#include <array>
#include <memory>
#include <numbers>
#include <vector>

namespace bwfirt {

namespace {

/// Has a triangle fetched, which may stand in two cache lines.
void prefetch(const Triangle& triangle) {
    __builtin_prefetch(&triangle.vertices.front());
    __builtin_prefetch(&triangle.vertices.back());
}

Sample& takeFirst(std::span<Sample>& samples) {
    Sample& first = samples.front();
    samples = samples.subspan(1);
    return first;
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, const RTKernel& kernel, const Camera& camera, int width,
                       int height, int inFlight)
    : scene_(scene),
      kernel_(kernel),
      lights_(scene),
      cameraRays_(camera, width, height),
      sensorResponse_(camera.sensorResponse),
      brdf_(scene.reflectance / std::numbers::pi),
      inFlight_(static_cast<std::size_t>(inFlight)) {}

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

void PathTracer::trace(std::span<Sample> samples, RayCounts& counts, RayListener& listener) const {
    for (Sample& sample : samples) {
        Path path = begin(sample);
        for (; path.goesOn; ++path.bounce) {
            const Ray ray = path.ray;
            const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
            ++counts.intersect;
            listener.intersected(ray, path.bounce, hit);
            arrive(path, hit);
            if (path.contribution > 0) {
                const bool isVisible = kernel_.kernelVisibility(path.x, path.y);
                ++counts.visibility;
                listener.connected(path.x, path.y, path.bounce, isVisible);
                if (isVisible)
                    path.radiance += path.contribution;
            }
        }
        end(path);
    }
}

void PathTracer::intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
    if (inFlight_ == 1)
        kernel_.RTKernel::kernelIntersectMany(rays, hits);
    else
        kernel_.kernelIntersectMany(rays, hits);
    for (const std::optional<Hit>& hit : hits)
        if (hit)
            prefetch(scene_.triangles[hit->triangle]);
}

void PathTracer::see(std::span<const RTKernel::Segment> segments, std::span<bool> visible) const {
    if (inFlight_ == 1)
        kernel_.RTKernel::kernelVisibleMany(segments, visible);
    else
        kernel_.kernelVisibleMany(segments, visible);
}

void PathTracer::replaceEnded(std::vector<Path>& paths, std::span<Sample>& samples) const {
    for (std::size_t i = 0; i < paths.size();) {
        if (paths[i].goesOn) {
            ++i;
            continue;
        }
        end(paths[i]);
        if (!samples.empty()) {
            paths[i] = begin(takeFirst(samples));
        } else {
            paths[i] = paths.back();
            paths.pop_back();
        }
    }
}

// Flattened, the steps of a path hand it to each other in registers (build/framework-cost).
[[gnu::flatten]] void PathTracer::trace(std::span<Sample> samples, RayCounts& counts) const {
    const std::size_t most = inFlight_ == 1 ? PATHS_IN_TURNS : inFlight_;
    std::vector<Path> paths;
    std::vector<Ray> rays(most);
    std::vector<std::optional<Hit>> hits(most);
    std::vector<RTKernel::Segment> segments(most);
    std::vector<std::size_t> connected(most);
    const auto visible = std::make_unique<bool[]>(most);
    paths.reserve(most);

    while (paths.size() < most && !samples.empty())
        paths.push_back(begin(takeFirst(samples)));
    while (!paths.empty()) {
        const std::size_t count = paths.size();
        for (std::size_t i = 0; i < count; ++i)
            rays[i] = paths[i].ray;
        intersect({rays.data(), count}, {hits.data(), count});
        counts.intersect += count;

        std::size_t connections = 0;
        for (std::size_t i = 0; i < count; ++i) {
            Path& path = paths[i];
            arrive(path, hits[i]);
            ++path.bounce;
            connected[connections] = i;
            segments[connections] = {path.x, path.y};
            connections += path.contribution > 0 ? 1 : 0;
        }
        see({segments.data(), connections}, {visible.get(), connections});
        counts.visibility += connections;
        for (std::size_t i = 0; i < connections; ++i)
            if (visible[i])
                paths[connected[i]].radiance += paths[connected[i]].contribution;

        replaceEnded(paths, samples);
    }
}

}  // namespace bwfirt
