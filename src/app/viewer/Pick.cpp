// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Pick.h"

#include "scene/TextReader.h"

namespace bwfirt {

namespace {

/// The part of a polygon on which plane·point >= 0 (Sutherland and Hodgman: Reentrant polygon
/// clipping, 1974).
std::vector<V3d> clip(const std::vector<V3d>& polygon, const V3d& plane, double offset) {
    std::vector<V3d> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const V3d& a = polygon[i];
        const V3d& b = polygon[(i + 1) % polygon.size()];
        const double ofA = plane.dot(a) - offset, ofB = plane.dot(b) - offset;
        if (ofA >= 0)
            inside.push_back(a);
        if ((ofA >= 0) != (ofB >= 0))
            inside.push_back(a + ofA / (ofA - ofB) * (b - a));
    }
    return inside;
}

}  // namespace

std::optional<Pick> pick(const CameraRays& rays, double x, double y, const RTKernel& kernel,
                         std::span<const Triangle> triangles) {
    const Ray ray = rays.through(x, y);
    const std::optional<Hit> hit = kernel.kernelIntersectGeometry(ray);
    if (!hit)
        return std::nullopt;
    const Triangle& triangle = triangles[hit->triangle];
    const double distance = hit->distance;
    return Pick{hit->triangle, distance, V3d(ray.origin) + distance * V3d(ray.direction),
                unitNormal(triangle), area(triangle)};
}

std::string describe(const std::optional<Pick>& pick) {
    if (!pick)
        return "triangle none";
    return "triangle " + std::to_string(pick->triangle) + " distance " +
           formatNumber(pick->distance) + " point " + formatNumbers(pick->point) + " normal " +
           formatNumbers(pick->normal) + " area " + formatNumber(pick->area);
}

std::vector<Imath::V2f> outline(const Triangle& triangle, const CameraRays& rays, int width,
                                int height) {
    std::vector<V3d> polygon;
    for (const V3f& vertex : triangle.vertices)
        polygon.push_back(rays.project(V3d(vertex)));

    // A little outside of the window, so that no line runs along its border.
    constexpr double BORDER = 10;
    constexpr double NEAREST = 1e-3;
    polygon = clip(polygon, {0, 0, 1}, NEAREST);
    polygon = clip(polygon, {1, 0, BORDER}, 0);
    polygon = clip(polygon, {-1, 0, width + BORDER}, 0);
    polygon = clip(polygon, {0, 1, BORDER}, 0);
    polygon = clip(polygon, {0, -1, height + BORDER}, 0);

    std::vector<Imath::V2f> points;
    for (const V3d& corner : polygon)
        points.emplace_back(static_cast<float>(corner.x / corner.z),
                            static_cast<float>(corner.y / corner.z));
    return points;
}

}  // namespace bwfirt
