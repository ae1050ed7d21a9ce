// SPDX-License-Identifier: GPL-3.0-only
#include "render/PathTracer.h"

#include "math/Sampling.h"
#include "render/Lanes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <tuple>
#include <vector>

namespace bwfirt {

namespace {

/// Has a triangle fetched, which may stand in two cache lines.
void prefetch(const Triangle& triangle) {
    __builtin_prefetch(&triangle.vertices.front());
    __builtin_prefetch(&triangle.vertices.back());
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

/// The paths that a thread follows at the same time, between two questions to the kernel. There is
/// room for some more, since LANES paths are written at once, of which not all need be kept.
struct PathTracer::Paths {
    explicit Paths(std::size_t most)
        : most(most),
          states(most + LANES),
          rays(most + LANES),
          hits(most),
          arrived(most + LANES),
          choices(most / LANES + 1),
          connections(most + LANES),
          segments(most + LANES),
          visible(std::make_unique<bool[]>(most)) {}

    struct State {
        Sample* sample;        ///< its value: the radiance found so far
        std::uint64_t random;  ///< the state of its random numbers
    };

    /// Random choices of LANES paths that met surfaces.
    struct Choices {
        std::array<const Emitter*, LANES> emitters;
        Doubles4 u, v;                 ///< point of the emitter
        Doubles4 x, y;                 ///< point of the unit disc: direction
        std::array<bool, LANES> goOn;  ///< into that direction
    };

    struct Connection {
        Sample* sample;
        double contribution;  ///< where V finds nothing between
    };

    std::size_t most;
    std::size_t count = 0;  ///< that are under way
    std::size_t begun = 0;  ///< the first of them that comes from the camera
    std::vector<State> states;
    std::vector<Ray> rays;  ///< to be followed next
    std::vector<std::optional<Hit>> hits;
    std::vector<std::size_t> arrived;  ///< paths that met a surface
    std::vector<Choices> choices;

    std::size_t connected = 0;  ///< connections for which V is asked
    std::vector<Connection> connections;
    std::vector<RTKernel::Segment> segments;
    std::unique_ptr<bool[]> visible;
};

void PathTracer::begin(Paths& paths, std::span<Sample>& samples) const {
    paths.begun = paths.count;
    const std::size_t news = std::min(paths.most - paths.count, samples.size());
    for (std::size_t first = 0; first < news; first += LANES) {
        std::array<Sample*, LANES> begun;  // lanes that are over repeat the last one
        for (std::size_t lane = 0; lane < LANES; ++lane)
            begun[lane] = &samples[std::min(first + lane, news - 1)];
        RandomLanes random(gather<Bits4>([&](std::size_t lane) { return begun[lane]->seed; }));
        const auto [u, v] = random.uniformSquare();
        const auto x = gather<Doubles4>([&](std::size_t lane) { return begun[lane]->x; });
        const auto y = gather<Doubles4>([&](std::size_t lane) { return begun[lane]->y; });
        const auto directions = scatterV3f(cameraRays_.direction<Doubles4>(x + u, y + v));
        for (std::size_t lane = 0; lane < LANES; ++lane) {
            begun[lane]->value = V3d(0);
            paths.rays[paths.count + first + lane] = {cameraRays_.origin(), directions[lane]};
            paths.states[paths.count + first + lane] = {begun[lane], random.state()[lane]};
        }
    }
    paths.count += news;
    samples = samples.subspan(news);
}

void PathTracer::choose(Paths& paths, std::size_t first) const {
    const std::size_t* const arrived = &paths.arrived[first];
    Paths::Choices& choices = paths.choices[first / LANES];
    RandomLanes random(
        gather<Bits4>([&](std::size_t lane) { return paths.states[arrived[lane]].random; }));
    const Doubles4 emitters = random.uniform();
    std::tie(choices.u, choices.v) = random.uniformSquare();
    const Doubles4 roulette = random.uniform();
    std::tie(choices.x, choices.y) = sampleDisc(random);
    choices.emitters = lights_.choose<LANES>(emitters);
    for (std::size_t lane = 0; lane < LANES; ++lane) {
        choices.goOn[lane] = roulette[lane] < scene_.reflectance;
        paths.states[arrived[lane]].random = random.state()[lane];
    }
}

void PathTracer::scatter(Paths& paths, std::size_t first, std::size_t lanes) const {
    std::array<Paths::State, LANES> states;
    std::array<const Ray*, LANES> rays;
    std::array<const Triangle*, LANES> triangles;
    std::array<float, LANES> distances;
    const Paths::Choices& choices = paths.choices[first / LANES];
    for (std::size_t lane = 0; lane < LANES; ++lane) {
        const std::size_t path = paths.arrived[first + lane];
        states[lane] = paths.states[path];
        rays[lane] = &paths.rays[path];
        triangles[lane] = &scene_.triangles[paths.hits[path]->triangle];
        distances[lane] = paths.hits[path]->distance;
    }
    const auto vertex = [&](std::size_t i) {
        return gatherV3f([&](std::size_t lane) { return triangles[lane]->vertices[i]; });
    };
    const auto numberOfEmitter = [&](double Emitter::*number) {
        return gather<Doubles4>([&](std::size_t lane) { return choices.emitters[lane]->*number; });
    };
    const auto vectorOfEmitter = [&](V3d Emitter::*vector) {
        return gatherV3d([&](std::size_t lane) { return choices.emitters[lane]->*vector; });
    };

    const V3Lanes origin = gatherV3f([&](std::size_t lane) { return rays[lane]->origin; });
    const V3Lanes direction = gatherV3f([&](std::size_t lane) { return rays[lane]->direction; });
    const auto distance = std::experimental::static_simd_cast<Doubles4>(
        gather<Floats4>([&](std::size_t lane) { return distances[lane]; }));
    const V3Lanes normal = unitAgainst(direction, edgeCross(vertex(0), vertex(1), vertex(2)));
    const Doubles4 offset(RTKernel::NORMAL_OFFSET);
    const V3Lanes x = origin + distance * direction + offset * normal;

    const V3Lanes light =
        pointOfTriangle(vectorOfEmitter(&Emitter::a), vectorOfEmitter(&Emitter::ab),
                        vectorOfEmitter(&Emitter::bc), choices.u, choices.v);
    const V3Lanes lightNormal = vectorOfEmitter(&Emitter::normal);
    const Doubles4 side = copysign(Doubles4(1), -lightNormal.dot(light - x));
    const V3Lanes y = light + side * offset * lightNormal;

    const V3Lanes d = y - x;
    const Doubles4 cosX = max(normal.dot(d), Doubles4(0));  // times |d|, as is the next
    const Doubles4 cosY = max(-side * lightNormal.dot(d), Doubles4(0));
    const Doubles4 distanceSquared = d.dot(d);
    const Doubles4 contribution =
        brdf_ * numberOfEmitter(&Emitter::radiance) * cosX * cosY /
        (distanceSquared * distanceSquared * numberOfEmitter(&Emitter::pdfArea));

    const auto xs = scatterV3f(x), ys = scatterV3f(y);
    const auto directions = scatterV3f(cosineHemisphere(normal, choices.x, choices.y));
    std::size_t count = paths.count, connected = paths.connected;
    for (std::size_t lane = 0; lane < LANES; ++lane) {
        paths.segments[connected] = {xs[lane], ys[lane]};
        paths.connections[connected] = {states[lane].sample, contribution[lane]};
        connected += (lane < lanes) & (contribution[lane] > 0);
        paths.rays[count] = {xs[lane], directions[lane]};
        paths.states[count] = states[lane];
        count += (lane < lanes) & choices.goOn[lane];
    }
    paths.count = count;
    paths.connected = connected;
}

void PathTracer::arrive(Paths& paths) const {
    for (std::size_t i = paths.begun; i < paths.count; ++i)
        if (paths.hits[i])
            paths.states[i].sample->value += V3d(lights_.radiance(paths.hits[i]->triangle));

    std::size_t arrived = 0;
    for (std::size_t i = 0; i < paths.count; ++i) {
        paths.arrived[arrived] = i;
        arrived += paths.hits[i] ? 1 : 0;
    }
    paths.count = paths.connected = 0;
    if (arrived == 0)
        return;
    // Lanes that are over repeat the last path.
    std::fill_n(&paths.arrived[arrived], LANES - 1, paths.arrived[arrived - 1]);
    for (std::size_t i = 0; i < arrived; ++i)
        prefetch(scene_.triangles[paths.hits[paths.arrived[i]]->triangle]);
    for (std::size_t first = 0; first < arrived; first += LANES)
        choose(paths, first);
    for (std::size_t first = 0; first < arrived; first += LANES)
        scatter(paths, first, arrived - first);
}

void PathTracer::end(std::span<Sample> samples) const {
    for (Sample& sample : samples)
        sample.value *= sensorResponse_;
}

void PathTracer::trace(std::span<Sample> samples, RayCounts& counts, RayListener& listener) const {
    Paths path(1);
    for (Sample& sample : samples) {
        std::span<Sample> rest(&sample, 1);
        begin(path, rest);
        for (int bounce = 0; path.count > 0; ++bounce) {
            path.hits[0] = kernel_.kernelIntersectGeometry(path.rays[0]);
            ++counts.intersect;
            listener.intersected(path.rays[0], bounce, path.hits[0]);
            arrive(path);
            path.begun = path.count;
            if (path.connected > 0) {
                const auto& [x, y] = path.segments[0];
                const bool isVisible = kernel_.kernelVisibility(x, y);
                ++counts.visibility;
                listener.connected(x, y, bounce, isVisible);
                if (isVisible)
                    sample.value += V3d(path.connections[0].contribution);
            }
        }
    }
    end(samples);
}

void PathTracer::intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
    if (inFlight_ == 1)
        kernel_.RTKernel::kernelIntersectMany(rays, hits);
    else
        kernel_.kernelIntersectMany(rays, hits);
}

void PathTracer::see(std::span<const RTKernel::Segment> segments, std::span<bool> visible) const {
    if (inFlight_ == 1)
        kernel_.RTKernel::kernelVisibleMany(segments, visible);
    else
        kernel_.kernelVisibleMany(segments, visible);
}

// Flattened, the steps of a path hand it to each other in registers (build/framework-cost).
[[gnu::flatten]] void PathTracer::trace(std::span<Sample> samples, RayCounts& counts) const {
    Paths paths(inFlight_ == 1 ? PATHS_IN_TURNS : inFlight_);
    std::span<Sample> rest = samples;
    for (begin(paths, rest); paths.count > 0; begin(paths, rest)) {
        intersect({paths.rays.data(), paths.count}, {paths.hits.data(), paths.count});
        counts.intersect += paths.count;
        arrive(paths);
        see({paths.segments.data(), paths.connected}, {paths.visible.get(), paths.connected});
        counts.visibility += paths.connected;
        for (std::size_t i = 0; i < paths.connected; ++i) {
            const auto& [sample, contribution] = paths.connections[i];
            sample->value += V3d(paths.visible[i] ? contribution : 0.0);
        }
    }
    end(samples);
}

}  // namespace bwfirt
