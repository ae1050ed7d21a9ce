// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Camera.h"

#include "test/fuzz/Fuzz.h"

#include <cmath>

namespace bwfirt {
namespace {

void checkValues(const Camera& camera) {
    fuzz::require(isFinite(camera.position), "the position is finite");
    fuzz::require(isFinite(camera.direction) && camera.direction != V3d(0),
                  "the direction is finite and not 0");
    fuzz::require(isFinite(camera.up) && camera.up != V3d(0), "up is finite and not 0");
    fuzz::require(camera.depth > 0 && std::isfinite(camera.depth), "the depth is above 0");
    fuzz::require(camera.filmSizeY > 0 && std::isfinite(camera.filmSizeY),
                  "the film height is above 0");
    fuzz::require(camera.sensorResponse >= 0 && std::isfinite(camera.sensorResponse),
                  "the sensor's response is not below 0");
    fuzz::require(!camera.referenceAverageIntensity || isFinite(*camera.referenceAverageIntensity),
                  "the reference average intensity is finite");
}

void checkRays(const Camera& camera) {
    constexpr int WIDTH = 640, HEIGHT = 480;
    const CameraRays rays(camera, WIDTH, HEIGHT);
    for (const int x : {0, WIDTH / 3, WIDTH}) {
        for (const int y : {0, HEIGHT / 3, HEIGHT}) {
            const Ray ray = rays.through(x, y);
            fuzz::require(isFinite(ray.origin), "a ray's origin is finite");
            fuzz::require(std::abs(ray.direction.length() - 1) < 1e-6,
                          "a ray's direction is of unit length");
        }
    }
}

bool same(const Camera& a, const Camera& b) {
    const auto &reference = a.referenceAverageIntensity, &other = b.referenceAverageIntensity;
    return fuzz::sameBits(a.position, b.position) && fuzz::sameBits(a.direction, b.direction) &&
           fuzz::sameBits(a.up, b.up) && fuzz::sameBits(a.depth, b.depth) &&
           fuzz::sameBits(a.filmSizeY, b.filmSizeY) &&
           fuzz::sameBits(a.sensorResponse, b.sensorResponse) &&
           reference.has_value() == other.has_value() &&
           (!reference || fuzz::sameBits(*reference, *other));
}

}  // namespace
}  // namespace bwfirt

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bwfirt;
    const std::optional<Camera> camera = fuzz::readAsFile(data, size, readCamera);
    if (!camera)
        return 0;
    checkValues(*camera);
    checkRays(*camera);
    writeCamera(fuzz::folder() / "written", *camera);
    fuzz::require(same(readCamera(fuzz::folder() / "written"), *camera),
                  "a written camera is the same when read again");

    Camera referenced = *camera;
    referenced.referenceAverageIntensity = V3d(0.25, 0.5, 0.75);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::filesystem::path path = fuzz::folder().write("referenced", bytes);
    writeReference(path, referenceLine(V3d(0.25, 0.5, 0.75), "a comment"));
    fuzz::require(same(readCamera(path), referenced),
                  "a camera file with a new reference is the same but for that");
    return 0;
}
