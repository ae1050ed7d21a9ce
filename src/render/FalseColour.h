// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "render/PathTracer.h"

namespace bwfirt {

/// What a false-colour image shows of the surface that a pixel sees; black where it sees none.
enum class View {
    NORMALS,     ///< the normal, turned to the viewer; x, y, z from [-1, 1] to red, green, blue
    TRIANGLES,   ///< a colour of its own for each triangle
    DISTANCE,    ///< dark blue at the camera to yellow at the length of the scene's diagonal
    QUERIES,     ///< questions that a path asks the kernel, from dark blue for 0 to yellow for 32
    TIME,        ///< seconds that h takes for the camera's ray: a number in all three channels
    EVEN_LIGHT,  ///< the reflectance times the cosine at which a surface is seen: needs no lights
    ERRORS,      ///< where the kernel disagrees with another, see ErrorView
};

/// All views but ERRORS.
class FalseColour : public Integrator {
  public:
    /// @param sceneDiagonal the length of the diagonal of boundsOf(scene)
    FalseColour(View view, const Scene& scene, const RTKernel& kernel, const Camera& camera,
                int width, int height, double sceneDiagonal);

    void trace(std::span<Sample> samples, RayCounts& counts) const override;

  private:
    double secondsOfIntersection(const Ray& ray) const;
    V3d colourOf(const Ray& ray, const Hit& hit) const;

    View view_;
    const Scene& scene_;
    const RTKernel& kernel_;
    CameraRays cameraRays_;
    std::optional<PathTracer> pathTracer_;  ///< for QUERIES
    double sceneDiagonal_;
};

}  // namespace bwfirt
