// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Camera.h"

namespace bwfirt {

CameraRays::CameraRays(const Camera& camera, int width, int height) : origin_(camera.position) {
    const V3d forward = camera.direction.normalized();
    const V3d right = forward.cross(camera.up.normalized()).normalized();
    const V3d up = right.cross(forward);
    const double pixelSize = camera.filmSizeY / height;
    alongRow_ = pixelSize * right;
    alongColumn_ = -pixelSize * up;
    toUpperLeft_ = camera.depth * forward - width / 2.0 * alongRow_ - height / 2.0 * alongColumn_;
}

V3d CameraRays::project(const V3d& point) const {
    const V3d forward = alongColumn_.cross(alongRow_);
    const V3d toPoint = point - V3d(origin_);
    const double z = toPoint.dot(forward) / toUpperLeft_.dot(forward);
    const V3d fromUpperLeft = toPoint - z * toUpperLeft_;
    return {fromUpperLeft.dot(alongRow_) / alongRow_.dot(alongRow_),
            fromUpperLeft.dot(alongColumn_) / alongColumn_.dot(alongColumn_), z};
}

}  // namespace bwfirt
