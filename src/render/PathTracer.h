// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "render/Integrator.h"
#include "scene/Camera.h"
#include "scene/LightSampler.h"
#include "scene/Scene.h"

#include <cstddef>
#include <optional>
#include <span>

namespace bwfirt {

/// Is told what a path tracer asked, in this order, and what the kernel answered.
class RayListener {
  public:
    virtual ~RayListener() = default;
    virtual void intersected(const Ray& ray, int bounce, const std::optional<Hit>& hit) = 0;
    virtual void connected(const V3f& x, const V3f& y, int bounce, bool isVisible) = 0;
};

/// Path tracing with next event estimation: at each vertex of a path a point on the lights is
/// chosen and connected by V, then the path goes on into a random direction, which h follows
/// (Veach: Robust Monte Carlo Methods for Light Transport Simulation, 1997; Pharr, Jakob,
/// Humphreys: Physically Based Rendering, section "Path tracing"). Surfaces are Lambertian on both
/// sides, and Russian roulette ends a path with the probability with which its surface absorbs, so
/// that the weight of a path stays 1.
///
/// A path's random numbers are its own. It is therefore the same path however many others are
/// traced at the same time, and a kernel's answer to one ray changes that ray's path only.
class PathTracer : public Integrator {
  public:
    /// Paths that a thread may keep in flight.
    static constexpr int MAX_IN_FLIGHT = 1024;

    /// @param inFlight paths for which each thread asks the kernel together; 1: ray by ray, a few
    ///        paths in turns
    PathTracer(const Scene& scene, const RTKernel& kernel, const Camera& camera, int width,
               int height, int inFlight);

    void trace(std::span<Sample> samples, RayCounts& counts) const override;

    /// The same ray by ray, path by path, with somebody who listens.
    void trace(std::span<Sample> samples, RayCounts& counts, RayListener& listener) const;

  private:
    /// Paths that a thread follows in turns where it asks ray by ray. A path's next ray depends on
    /// the answer to its last one; with only one path a processor could do none of the path
    /// tracer's work and none of the kernel's while it waits for the other.
    static constexpr std::size_t PATHS_IN_TURNS = 64;

    struct Paths;

    /// As many of the next samples' paths begin as there is room for.
    void begin(Paths& paths, std::span<Sample>& samples) const;

    /// From the answers of h to the questions for V and to the next ones for h. Paths that met no
    /// surface, or are absorbed by it, end. Nothing here waits for V.
    void arrive(Paths& paths) const;

    /// Draw the random numbers of LANES paths side by side, from this one on of those that met a
    /// surface, and compute what follows from them: connections and next rays, which are appended
    /// to those that are asked, of the first `lanes` paths only. All numbers are drawn before any
    /// triangle is needed, which arrive() has fetched.
    void choose(Paths& paths, std::size_t first) const;
    void scatter(Paths& paths, std::size_t first, std::size_t lanes) const;

    /// Ask h and V, ray by ray or for all rays together.
    void intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;
    void see(std::span<const RTKernel::Segment> segments, std::span<bool> visible) const;

    /// Scales what the paths of the samples found.
    void end(std::span<Sample> samples) const;

    const Scene& scene_;
    const RTKernel& kernel_;
    LightSampler lights_;
    CameraRays cameraRays_;
    double sensorResponse_;
    double brdf_;  ///< of every surface: reflectance / pi
    std::size_t inFlight_;
};

}  // namespace bwfirt
