// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Framing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace bwfirt {
namespace {

using Imath::Box3d;

/// Where the corner farthest out is seen: 1 at the edge of an image of the default size.
double farthestOut(const Camera& camera, const Box3d& box) {
    const V3d right = camera.direction.cross(camera.up).normalized();
    const V3d upInImage = right.cross(camera.direction);
    double farthest = 0;
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            for (const double z : {box.min.z, box.max.z}) {
                const V3d seen = V3d(x, y, z) - camera.position;
                const double film = seen.dot(camera.direction) * camera.filmSizeY / 2;
                EXPECT_GT(film, 0);
                farthest = std::max({farthest, std::abs(seen.dot(upInImage)) / film,
                                     std::abs(seen.dot(right)) / film / DEFAULT_ASPECT});
            }
    return farthest;
}

TEST(Framing, BoxesOfAllShapesFillTheImageAndStayInside) {
    for (const V3d& size : {V3d(1), V3d(100, 1, 1), V3d(1, 100, 1), V3d(1, 1, 100), V3d(9, 0, 5)})
        for (const V3d& up : {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, -1)}) {
            const Box3d box(V3d(3, 4, 5), V3d(3, 4, 5) + size);
            const Camera camera = framingCamera(box, up);
            EXPECT_GT(farthestOut(camera, box), 0.8);
            EXPECT_LT(farthestOut(camera, box), 1);
            EXPECT_EQ(camera.up, up);
            EXPECT_LT(camera.direction.dot(up), 0) << "the camera looks down";
        }
}

}  // namespace
}  // namespace bwfirt
