// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Framing.h"

#include <gtest/gtest.h>

#include <Imath/ImathBox.h>

#include <algorithm>
#include <vector>

namespace bwfirt {
namespace {

/// Triangles whose vertices are the corners of a box.
std::vector<Triangle> trianglesIn(const V3d& low, const V3d& size) {
    std::vector<Triangle> triangles;
    for (int corner = 0; corner < 8; ++corner) {
        const auto vertex = [&](int bits) {
            return V3f(low + V3d(bits & 1, bits >> 1 & 1, bits >> 2 & 1) * size);
        };
        triangles.push_back({{vertex(corner), vertex(corner ^ 3), vertex(corner ^ 6)}});
    }
    return triangles;
}

/// Where the outermost vertices are seen: -1 and 1 are the edges of an image of the default size.
Imath::Box2d extentInImage(const Camera& camera, const std::vector<Triangle>& triangles) {
    const V3d right = camera.direction.cross(camera.up).normalized();
    const V3d upInImage = right.cross(camera.direction);
    Imath::Box2d extent;
    for (const Triangle& triangle : triangles)
        for (const V3f& vertex : triangle.vertices) {
            const V3d seen = V3d(vertex) - camera.position;
            const double film = seen.dot(camera.direction) * camera.filmSizeY / 2;
            EXPECT_GT(film, 0);
            extent.extendBy(
                Imath::V2d(seen.dot(right) / film / DEFAULT_ASPECT, seen.dot(upInImage) / film));
        }
    return extent;
}

TEST(Framing, ModelsOfAllShapesFillTheImageAndStayInside) {
    for (const V3d& size : {V3d(1), V3d(100, 1, 1), V3d(1, 100, 1), V3d(1, 1, 100), V3d(9, 0, 5)})
        for (const V3d& up : {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, -1)}) {
            const std::vector<Triangle> triangles = trianglesIn({3, 4, 5}, size);
            const Camera camera = framingCamera(triangles, up);
            const Imath::Box2d extent = extentInImage(camera, triangles);
            EXPECT_GT(std::max(extent.size().x, extent.size().y), 1.9);
            for (const double edge : {extent.max.x, extent.max.y, -extent.min.x, -extent.min.y})
                EXPECT_LT(edge, 0.96);
            EXPECT_EQ(camera.up, up);
            EXPECT_LT(camera.direction.dot(up), 0) << "the camera looks down";
        }
}

}  // namespace
}  // namespace bwfirt
