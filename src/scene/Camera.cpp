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

}  // namespace bwfirt
