// SPDX-License-Identifier: GPL-3.0-only
#include "test/Oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bwfirt::test {

namespace {

/// Rounding errors of single precision, relative to the largest coordinate, that a kernel may make.
constexpr double ROUNDING = 64 * std::numeric_limits<float>::epsilon();

/// What can be said of a ray and a triangle in spite of rounding. The hit is at t give or take the
/// tolerance.
struct Meeting {
    bool isPossible = false;
    bool isCertain = false;
    double t = 0;
    double tolerance = 0;
};

double largest(const V3d& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// @param direction of unit length
Meeting meet(const V3d& origin, const V3d& direction, const Triangle& triangle) {
    if (!hasArea(triangle))
        return {};
    const V3d normal = unitNormal(triangle);
    const double cosTheta = std::abs(normal.dot(direction));
    double scale = largest(origin);
    for (const V3f& vertex : triangle.vertices)
        scale = std::max(scale, largest(V3d(vertex)));
    // A ray that is off by a little to the side is off by this along a plane that it grazes.
    const double tolerance = ROUNDING * scale / cosTheta;
    if (cosTheta < ROUNDING)
        return {true, false, 0, std::numeric_limits<double>::infinity()};

    const double t = normal.dot(V3d(triangle.vertices[0]) - origin) / normal.dot(direction);
    const V3d point = origin + t * direction;
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const V3d a(triangle.vertices[i]), b(triangle.vertices[(i + 1) % 3]);
        const V3d inward = normal.cross(b - a).normalized();
        inside = std::min(inside, inward.dot(point - a));
    }
    return {inside > -tolerance && t > -tolerance, inside > tolerance && t > tolerance, t,
            tolerance};
}

testing::AssertionResult failure(const char* what, std::size_t triangle, double t) {
    return testing::AssertionFailure() << what << " triangle " << triangle << " at " << t;
}

}  // namespace

testing::AssertionResult Oracle::accepts(const Ray& ray, const std::optional<Hit>& hit) const {
    const V3d origin(ray.origin), direction(ray.direction);
    double farthest = std::numeric_limits<double>::infinity();
    if (hit) {
        if (hit->triangle >= triangles_.size())
            return failure("no such", hit->triangle, 0);
        const Meeting met = meet(origin, direction, triangles_[hit->triangle]);
        if (!(hit->distance > 0 && std::isfinite(hit->distance)))
            return failure("not a distance for", hit->triangle, hit->distance);
        if (!met.isPossible)
            return failure("the ray misses", hit->triangle, met.t);
        if (std::abs(hit->distance - met.t) > met.tolerance + ROUNDING * std::abs(met.t))
            return failure("wrong distance to", hit->triangle, met.t) << ", not " << hit->distance;
        farthest = hit->distance;
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Meeting met = meet(origin, direction, triangles_[i]);
        if (met.isCertain && met.t * (1 + ROUNDING) + 2 * met.tolerance < farthest)
            return failure("overlooked", i, met.t);
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult Oracle::accepts(const V3f& x, const V3f& y, bool isVisible) const {
    const V3d origin(x), segment = V3d(y) - origin;
    const double length = segment.length();
    const V3d direction = segment / length;
    bool isExcused = false;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Meeting met = meet(origin, direction, triangles_[i]);
        if (isVisible && met.isCertain && met.t < length - met.tolerance)
            return failure("not visible because of", i, met.t);
        isExcused = isExcused || (met.isPossible && met.t < length + met.tolerance);
    }
    if (!isVisible && !isExcused)
        return testing::AssertionFailure() << "nothing is between the points";
    return testing::AssertionSuccess();
}

}  // namespace bwfirt::test
