// SPDX-License-Identifier: GPL-3.0-only
#include "scene/LightSampler.h"

#include "math/Random.h"
#include "test/Shapes.h"
#include "test/Statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numbers>

namespace bwfirt {
namespace {

/// Three lights: areas 0.5 and 0.5 at exitance 3, area 2 at exitance 1, area 8 at exitance 0, with
/// a triangle without area inside the first range and one that emits nothing between them.
Scene threeLights() {
    Scene scene;
    scene.triangles = {
        {{V3f(0, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)}}, {{V3f(5, 5, 0), V3f(5, 5, 0), V3f(6, 6, 0)}},
        {{V3f(2, 0, 0), V3f(3, 0, 0), V3f(2, 1, 0)}}, {{V3f(9, 9, 9), V3f(9, 9, 8), V3f(9, 8, 9)}},
        {{V3f(0, 4, 0), V3f(2, 4, 0), V3f(0, 6, 0)}}, {{V3f(0, 8, 0), V3f(4, 8, 0), V3f(0, 12, 0)}},
    };
    scene.lights = {{4, 4, 1}, {0, 2, 3}, {5, 5, 0}};
    return scene;
}

TEST(LightSampler, ChoosesTrianglesByPower) {
    const LightSampler lights(threeLights());
    EXPECT_DOUBLE_EQ(lights.totalPower(), 5);
    Random random(1);
    std::vector<std::size_t> counts(3);
    for (int i = 0; i < 50000; ++i) {
        for (const Emitter* const emitter :
             lights.choose<2>(std::array{random.uniform(), random.uniform()})) {
            const V3d vertex = emitter->a;
            ++counts[vertex.y >= 4 ? 2 : vertex.x >= 2 ? 1 : 0];
        }
    }
    EXPECT_TRUE(test::fits(counts, std::vector<double>{1.5 / 5, 1.5 / 5, 2.0 / 5}));
}

// The density of a point is exitance / total power, so that it integrates to one over all lights.
TEST(LightSampler, GivesTheDensityPerAreaAndTheRadiance) {
    const LightSampler lights(threeLights());
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const Emitter& emitter = *lights.choose<1>(std::array{random.uniform()})[0];
        const double exitance = emitter.a.y >= 4 ? 1 : 3;
        EXPECT_DOUBLE_EQ(emitter.pdfArea, exitance / 5);
        EXPECT_DOUBLE_EQ(emitter.radiance, exitance / std::numbers::pi);
        EXPECT_EQ(emitter.normal, V3d(0, 0, 1));
    }
}

TEST(LightSampler, KnowsTheRadianceOfEveryTriangle) {
    const LightSampler lights(threeLights());
    const std::vector<double> exitances = {3, 3, 3, 0, 1, 0};
    for (std::uint32_t i = 0; i < exitances.size(); ++i)
        EXPECT_DOUBLE_EQ(lights.radiance(i), exitances[i] / std::numbers::pi) << i;
}

}  // namespace
}  // namespace bwfirt
