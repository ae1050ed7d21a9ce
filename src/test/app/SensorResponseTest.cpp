// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/SensorResponse.h"

#include "test/Shapes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace bwfirt {
namespace {

/// The response in a closed box whose walls all emit: its radiance is exitance / pi / (1 - 0.7).
double responseInBox(double exitance, Camera camera = {}) {
    Scene scene;
    scene.triangles = test::box(V3f(-1), V3f(1));
    if (exitance > 0)
        scene.lights = {{0, 11, exitance}};
    const auto kernel = createKernel();
    kernel->kernelInitialize(scene.triangles);
    return fittingSensorResponse(scene, *kernel, camera);
}

TEST(SensorResponse, BringsPicturesToAMediumBrightness) {
    for (const double radiance : {1e-6, 0.01, 1.0, 3000.0}) {
        const double response = responseInBox(0.3 * std::numbers::pi * radiance);
        EXPECT_GT(response * radiance, 0.1);
        EXPECT_LT(response * radiance, 0.6);
        EXPECT_EQ(std::exp2(std::round(std::log2(response))), response) << "a power of two";
    }
}

TEST(SensorResponse, DoesNotDependOnThatOfTheCamera) {
    Camera camera;
    camera.sensorResponse = 1000;
    EXPECT_EQ(responseInBox(1, camera), responseInBox(1));
}

TEST(SensorResponse, IsOneWithoutLight) {
    EXPECT_EQ(responseInBox(0), 1);
}

}  // namespace
}  // namespace bwfirt
