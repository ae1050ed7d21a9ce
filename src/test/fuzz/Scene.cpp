// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Scene.h"

#include "scene/LightSampler.h"
#include "test/Shapes.h"
#include "test/fuzz/Fuzz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bwfirt {
namespace {

/// The triangle files that the scenes of the corpus name.
constexpr std::array TRIANGLE_FILES = {"a.ra2", "a b#c.ra2", "a\"b.ra2"};

/// So many triangles that some hundred lights over all of them would take a conspicuous amount of
/// memory. The first has no area, the second is not finite.
void writeTriangleFiles() {
    std::mt19937 random(1);
    test::Triangles triangles = test::soup(1000, 0.1, random);
    triangles[0].vertices[1] = triangles[0].vertices[0];
    triangles[1].vertices[2].y = std::numeric_limits<float>::quiet_NaN();
    for (const char* name : TRIANGLE_FILES)
        writeTriangles(fuzz::folder() / name, triangles);
}

void checkValues(const Scene& scene) {
    fuzz::require(scene.reflectance >= 0 && scene.reflectance < 1, "reflectance is in [0, 1)");
    std::vector<Light> lights = scene.lights;
    std::sort(lights.begin(), lights.end(), [](auto& a, auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        fuzz::require(light.first <= light.last, "a light's first triangle is not after its last");
        fuzz::require(light.last < scene.triangles.size(), "a light's triangles exist");
        fuzz::require(light.exitance >= 0 && std::isfinite(light.exitance),
                      "an exitance is finite and not negative");
        fuzz::require(i == 0 || lights[i - 1].last < light.first,
                      "a triangle belongs to one light at most");
        fuzz::require(std::any_of(scene.triangles.begin() + light.first,
                                  scene.triangles.begin() + light.last + 1, hasArea),
                      "a light has an area");
    }
    if (!lights.empty()) {
        const double power = LightSampler(scene).totalPower();
        fuzz::require(power > 0 && std::isfinite(power), "the lights' power is finite, not 0");
    }
}

bool same(const Scene& a, const Scene& b) {
    return a.trianglesPath == b.trianglesPath && fuzz::sameBits(a.reflectance, b.reflectance) &&
           std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(),
                      fuzz::sameBits<Light>) &&
           std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(),
                      b.triangles.end(), fuzz::sameBits<Triangle>);
}

}  // namespace
}  // namespace bwfirt

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
    bwfirt::writeTriangleFiles();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bwfirt;
    const std::optional<Scene> scene = fuzz::readAsFile(data, size, readScene);
    if (!scene)
        return 0;
    checkValues(*scene);
    writeScene(fuzz::folder() / "written", *scene);
    fuzz::require(same(readScene(fuzz::folder() / "written"), *scene),
                  "a written scene is the same when read again");
    return 0;
}
