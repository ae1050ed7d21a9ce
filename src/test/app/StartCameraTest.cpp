// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/StartCamera.h"
#include "app/viewer/start-camera/UpAxis.h"
#include "test/Shapes.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace bwfirt {
namespace {

constexpr int Y = 1, Z = 2;

/// A kernel that counts what it is asked.
class Counter : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        kernel_->kernelInitialize(triangles);
    }
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        ++asked;
        return kernel_->kernelIntersectGeometry(ray);
    }
    mutable int asked = 0;

  private:
    std::unique_ptr<RTKernel> kernel_ = createKernel();
};

/// A scene, and what its start camera sees of it.
struct Start {
    explicit Start(const test::Triangles& triangles) {
        scene.triangles = triangles;
        kernel.kernelInitialize(scene.triangles);
        camera = startCamera(scene, kernel);
        queries = kernel.asked;
        const CameraRays rays(camera, WIDTH, HEIGHT);
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x)
                picture.push_back(kernel.kernelIntersectGeometry(rays.through(x + 0.5, y + 0.5)));
    }

    std::vector<float> sortedDistances() const {
        std::vector<float> distances;
        for (const std::optional<Hit>& hit : picture)
            if (hit)
                distances.push_back(hit->distance);
        std::sort(distances.begin(), distances.end());
        return distances;
    }

    static constexpr int WIDTH = 20, HEIGHT = 15;
    Scene scene;
    Counter kernel;
    Camera camera;
    int queries = 0;
    std::vector<std::optional<Hit>> picture;
};

/// Turned about the x axis, so that z is where y was.
test::Triangles withUp(int axis, test::Triangles triangles) {
    if (axis == Z)
        for (Triangle& triangle : triangles)
            for (V3f& vertex : triangle.vertices)
                vertex = V3f(vertex.x, -vertex.z, vertex.y);
    return triangles;
}

/// A closed room, 3 high, with a few boxes on its floor.
test::Triangles room() {
    return test::joined({test::box(V3f(0), V3f(9, 3, 5)), test::box(V3f(2, 0, 1), V3f(3, 1, 2)),
                         test::box(V3f(5, 0, 0), V3f(6, 2, 1)),
                         test::box(V3f(7, 0, 4), V3f(8, 1, 5))});
}

class UpAxis : public testing::TestWithParam<int> {};

TEST_P(UpAxis, IsThatOfARoom) {
    const Start start(withUp(GetParam(), room()));
    V3d up(0);
    up[GetParam()] = 1;
    EXPECT_EQ(start.camera.up, up);
    EXPECT_LT(std::abs(start.camera.direction.normalized().dot(up)), 0.7) << "not at the feet";
}

TEST_P(UpAxis, IsThatOfAnObjectOnTheGround) {
    const Start start(withUp(GetParam(), test::joined({test::sphere(V3f(0, 1, 0), 1, 3, 0.1),
                                                       test::quad(V3f(-9, 0, -9), V3f(-9, 0, 9),
                                                                  V3f(9, 0, 9), V3f(9, 0, -9))})));
    EXPECT_EQ(upAxis(start.scene), GetParam());
}

TEST_P(UpAxis, LetsARoomFillThePictureAtADistance) {
    const Start start(withUp(GetParam(), room()));
    EXPECT_TRUE(boundsOf(start.scene).intersects(start.camera.position));
    const std::vector<float> distances = start.sortedDistances();
    ASSERT_EQ(distances.size(), start.picture.size()) << "rays leave a closed room";
    EXPECT_GT(distances[distances.size() / 2], 2) << "the nose is at a wall";
    EXPECT_GT(distances.front(), 0.1) << "something is right before the eye";
}

INSTANTIATE_TEST_SUITE_P(Axes, UpAxis, testing::Values(Y, Z));

TEST(StartCamera, SeesASingleObjectFromOutsideInTheMiddleOfThePicture) {
    const V3d centre(3, 4, 5);
    test::Triangles object = test::sphere(V3f(centre), 2, 3, 0.1);
    for (const bool isClockwise : {false, true}) {
        SCOPED_TRACE(isClockwise ? "clockwise" : "counter-clockwise");
        if (isClockwise)
            for (Triangle& triangle : object)
                std::swap(triangle.vertices[0], triangle.vertices[1]);
        const Start start(object);
        EXPECT_TRUE(boundsOf(start.scene).intersects(start.camera.position));
        EXPECT_GT((start.camera.position - centre).length(), 2);
        for (int y = Start::HEIGHT / 3; y < 2 * Start::HEIGHT / 3; ++y)
            for (int x = Start::WIDTH / 3; x < 2 * Start::WIDTH / 3; ++x)
                EXPECT_TRUE(start.picture[static_cast<std::size_t>(y * Start::WIDTH + x)]);
    }
}

TEST(StartCamera, IsNearASmallObjectOnAVastGround) {
    const Start start(test::joined(
        {test::sphere(V3f(50, 1, -30), 1, 3, 0.1),
         test::quad(V3f(-900, 0, -900), V3f(-900, 0, 900), V3f(900, 0, 900), V3f(900, 0, -900))}));
    EXPECT_LT((start.camera.position - V3d(50, 1, -30)).length(), 10);
}

TEST(StartCamera, SeesAFlatSceneFromBesideIt) {
    for (const int axis : {Y, Z}) {
        const Start start(
            withUp(axis, test::quad(V3f(-1, 0, -1), V3f(-1, 0, 1), V3f(1, 0, 1), V3f(1, 0, -1))));
        EXPECT_GT(start.sortedDistances().size(), start.picture.size() / 3);
    }
}

TEST(StartCamera, DependsOnTheSceneAlone) {
    const Start one(room()), other(room());
    EXPECT_EQ(cameraText(one.camera), cameraText(other.camera));
}

TEST(StartCamera, TakesFewQueries) {
    EXPECT_LE(Start(room()).queries, 3000);
}

/// Coordinates that a triangle file may hold, but a renderer would rather not meet.
TEST(StartCamera, IsValidForEveryScene) {
    constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
    constexpr float LARGEST = std::numeric_limits<float>::max();
    constexpr float SMALLEST = std::numeric_limits<float>::denorm_min();
    const auto cube = [](float half) { return test::box(V3f(-half), V3f(half)); };
    const Triangle point = {{V3f(1e17F), V3f(1e17F), V3f(1e17F)}};
    const Triangle one = {{V3f(0), V3f(1, 0, 0), V3f(0, 0, 1)}};
    const Triangle nothing = {{V3f(NOT_A_NUMBER), V3f(1), V3f(2)}};
    const std::vector<test::Triangles> scenes = {
        {},
        {nothing, nothing},
        {one},
        {point, point},
        {nothing, one},
        cube(1e-12F),
        cube(SMALLEST),
        cube(1e17F),
        cube(LARGEST),
        test::quad(V3f(-LARGEST, 0, 0), V3f(0, -LARGEST, 0), V3f(LARGEST, 0, 0),
                   V3f(0, LARGEST, 0)),
        test::joined({cube(1e-12F), cube(LARGEST)}),
        test::box(V3f(1e17F, 0, 0), V3f(1.1e17F, 1, 1e-12F)),
    };
    const test::TemporaryFolder folder;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        SCOPED_TRACE("scene " + std::to_string(i));
        const Start start(scenes[i]);
        writeCamera(folder / "start.camera", start.camera);
        ASSERT_NO_THROW(readCamera(folder / "start.camera"));
        EXPECT_EQ(cameraText(readCamera(folder / "start.camera")), cameraText(start.camera));
    }
}

}  // namespace
}  // namespace bwfirt
