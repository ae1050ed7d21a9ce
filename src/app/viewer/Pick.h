// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "scene/Camera.h"

#include <span>
#include <vector>

namespace bwfirt {

/// The triangle that a pixel shows.
struct Pick {
    std::uint32_t triangle = 0;
    double distance = 0;
    V3d point;
    V3d normal;  ///< unit length, counter-clockwise vertices seen from its tip
    double area = 0;
};

/// Asks the kernel for what is seen at an image point, in pixels from the upper left corner.
std::optional<Pick> pick(const CameraRays& rays, double x, double y, const RTKernel& kernel,
                         std::span<const Triangle> triangles);

/// "triangle 7 distance 2.5 point 0 1 2 normal 0 0 1 area 0.5", or "triangle none".
std::string describe(const std::optional<Pick>& pick);

/// The part of a triangle's image that is about the window, as a polygon in pixels; empty where the
/// triangle is behind the camera or off the image.
std::vector<Imath::V2f> outline(const Triangle& triangle, const CameraRays& rays, int width,
                                int height);

}  // namespace bwfirt
