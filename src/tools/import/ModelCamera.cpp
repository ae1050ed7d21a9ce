// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/ModelCamera.h"

#include "tools/import/Framing.h"

#include <assimp/camera.h>
#include <assimp/scene.h>

#include <numbers>

namespace bwfirt {

namespace {

using Matrix = aiMatrix4x4t<double>;
using Vector = aiVector3t<double>;

constexpr double DEGREE = std::numbers::pi / 180;

/// tan(vertical field of view / 2), or 0 where it makes no sense.
///
/// aiCamera calls mHorizontalFOV the half angle, but all readers of assimp 5.2 set the full one.
/// Those of glTF and Irrlicht, whose files tell the vertical angle, multiply it by the aspect
/// ratio.
double tanHalfFieldOfView(const aiCamera& camera, const std::string& format) {
    const bool knowsAspect = std::isfinite(camera.mAspect) && camera.mAspect > 0;
    const bool isVertical = format.starts_with("glTF") || format.starts_with("Irrlicht");
    double angle = camera.mHorizontalFOV;
    if (isVertical && knowsAspect)
        angle /= camera.mAspect;
    if (!(angle > 0 && angle < std::numbers::pi))
        return 0;
    // The readers of FBX and Collada leave a degree or less where the file does not tell the angle.
    if (!isVertical && angle < 1.001 * DEGREE)
        angle = 45 * DEGREE;
    const double tangent = std::tan(angle / 2);
    return isVertical ? tangent : tangent / (knowsAspect ? camera.mAspect : DEFAULT_ASPECT);
}

Matrix toRoot(const aiNode* node) {
    Matrix transform;
    for (; node != nullptr; node = node->mParent)
        transform = static_cast<Matrix>(node->mTransformation) * transform;
    return transform;
}

V3d vector(const Vector& v) {
    return {v.x, v.y, v.z};
}

bool isUsable(const Camera& camera) {
    const V3d right = camera.direction.normalized().cross(camera.up.normalized());
    return isFinite(camera.position) && isFinite(right) && right.length() > 1e-6 &&
           camera.filmSizeY > 0;
}

std::optional<Camera> converted(const aiCamera& source, const aiScene& scene,
                                const std::string& format) {
    const Matrix transform = toRoot(scene.mRootNode->FindNode(source.mName));
    const aiMatrix3x3t<double> rotation(transform);
    // The reader of glTF repeats the node's translation here.
    const Vector position = format.starts_with("glTF") ? Vector() : Vector(source.mPosition);
    Camera camera;
    camera.position = vector(transform * position);
    camera.direction = vector(rotation * Vector(source.mLookAt)).normalized();
    camera.up = vector(rotation * Vector(source.mUp)).normalized();
    camera.filmSizeY = 2 * tanHalfFieldOfView(source, format);
    return isUsable(camera) ? std::optional(camera) : std::nullopt;
}

}  // namespace

std::optional<Camera> firstCamera(const aiScene& scene, const std::string& format) {
    for (unsigned i = 0; i < scene.mNumCameras; ++i)
        if (std::optional<Camera> camera = converted(*scene.mCameras[i], scene, format))
            return camera;
    return std::nullopt;
}

}  // namespace bwfirt
