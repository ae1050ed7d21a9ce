// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Framing.h"

#include <algorithm>

namespace bwfirt {

namespace {

constexpr double TAN_HALF_FIELD_OF_VIEW = 0.4;  // vertical; about 44 degrees
constexpr double MARGIN = 1.05;

}  // namespace

Camera framingCamera(const Imath::Box3d& box, const V3d& up) {
    const V3d side = up.x == 0 ? V3d(1, 0, 0) : V3d(0, 1, 0), front = side.cross(up);
    const V3d toCamera = (0.5 * up + 0.6 * side + front).normalized();
    const V3d right = up.cross(toCamera).normalized();
    const V3d upInImage = toCamera.cross(right);

    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const V3d point((corner & 1) != 0 ? box.max.x : box.min.x,
                        (corner & 2) != 0 ? box.max.y : box.min.y,
                        (corner & 4) != 0 ? box.max.z : box.min.z);
        const V3d fromCentre = point - box.center();
        const double across = std::max(std::abs(fromCentre.dot(upInImage)),
                                       std::abs(fromCentre.dot(right)) / DEFAULT_ASPECT);
        distance = std::max(distance, fromCentre.dot(toCamera) + across / TAN_HALF_FIELD_OF_VIEW);
    }

    Camera camera;
    camera.position = box.center() + MARGIN * distance * toCamera;
    camera.direction = -toCamera;
    camera.up = up;
    camera.depth = 1;
    camera.filmSizeY = 2 * TAN_HALF_FIELD_OF_VIEW;
    return camera;
}

}  // namespace bwfirt
