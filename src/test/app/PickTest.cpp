// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Pick.h"

#include "test/Shapes.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

/// A wall of two triangles at z = -2, the lower right one and the upper left one.
class Picking : public testing::Test {
  protected:
    Picking() { kernel->kernelInitialize(triangles); }

    test::Triangles triangles =
        test::quad(V3f(-1, -1, -2), V3f(1, -1, -2), V3f(1, 1, -2), V3f(-1, 1, -2));
    std::unique_ptr<RTKernel> kernel = createKernel();
    CameraRays rays{Camera{}, 200, 100};  // sees from y = -1 to 1 at the wall
};

TEST_F(Picking, FindsTheTriangleUnderThePixel) {
    const std::optional<Pick> lower = pick(rays, 100, 75, *kernel, triangles);
    ASSERT_TRUE(lower);
    EXPECT_EQ(lower->triangle, 0u);
    EXPECT_NEAR((lower->point - V3d(0, -0.5, -2)).length(), 0, 1e-6);
    EXPECT_NEAR(lower->distance, std::sqrt(4.25), 1e-6);
    EXPECT_EQ(lower->normal, V3d(0, 0, 1));
    EXPECT_EQ(lower->area, 2);
    EXPECT_EQ(pick(rays, 100, 25, *kernel, triangles)->triangle, 1u);
    EXPECT_FALSE(pick(rays, 10, 50, *kernel, triangles)) << "left of the wall";
}

TEST_F(Picking, IsDescribedInOneLineOfNamesAndNumbers) {
    EXPECT_EQ(describe(Pick{7, 2.5, V3d(0, 1, 2), V3d(0, 0, 1), 0.5}),
              "triangle 7 distance 2.5 point 0 1 2 normal 0 0 1 area 0.5");
    EXPECT_EQ(describe(std::nullopt), "triangle none");
}

TEST_F(Picking, ProjectionUndoesTheCameraRays) {
    Camera camera;
    camera.position = V3d(1, 2, 3);
    camera.direction = V3d(1, -2, 0.5);
    camera.up = V3d(0.3, 1, 0);
    camera.depth = 1.7;
    const CameraRays turned(camera, 320, 240);
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {320.0, 240.0}, {17.25, 200.5}}) {
        const Ray ray = turned.through(x, y);
        const V3d image = turned.project(V3d(ray.origin) + 5.0 * V3d(ray.direction));
        EXPECT_GT(image.z, 0);
        EXPECT_NEAR(image.x / image.z, x, 1e-4);
        EXPECT_NEAR(image.y / image.z, y, 1e-4);
        EXPECT_LT(turned.project(V3d(ray.origin) - V3d(ray.direction)).z, 0) << "behind";
    }
}

TEST_F(Picking, TheOutlineOfAVisibleTriangleHasItsCorners) {
    const auto points = outline(triangles[0], rays, 200, 100);
    ASSERT_EQ(points.size(), 3u);
    const std::array<Imath::V2f, 3> corners = {{{50, 100}, {150, 100}, {150, 0}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
        EXPECT_NEAR((points[i] - corners[i]).length(), 0, 1e-3);
}

TEST_F(Picking, TheOutlineIsCutToTheWindowAndToWhatIsBeforeTheCamera) {
    const Triangle floor{{V3f(-1e6, -1, -1e6), V3f(1e6, -1, -1e6), V3f(0, -1, 1e6)}};
    const auto points = outline(floor, rays, 200, 100);
    ASSERT_GE(points.size(), 3u);
    for (const Imath::V2f& point : points) {
        EXPECT_TRUE(point.x >= -11 && point.x <= 211) << point;
        EXPECT_TRUE(point.y >= 49 && point.y <= 111) << point;
    }
    const Triangle behind{{V3f(-1, 0, 2), V3f(1, 0, 2), V3f(0, 1, 2)}};
    EXPECT_TRUE(outline(behind, rays, 200, 100).empty());
}

}  // namespace
}  // namespace bwfirt
