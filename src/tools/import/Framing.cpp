// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Framing.h"

#include <algorithm>
#include <limits>

namespace bwfirt {

namespace {

constexpr double TAN_HALF_FIELD_OF_VIEW = 0.4;  // vertical; about 44 degrees
constexpr double MARGIN = 1.05;

}  // namespace

Camera framingCamera(std::span<const Triangle> triangles, const V3d& up) {
    const V3d side = up.x == 0 ? V3d(1, 0, 0) : V3d(0, 1, 0), front = side.cross(up);
    const V3d toCamera = (0.5 * up + 0.6 * side + front).normalized();
    const V3d right = up.cross(toCamera).normalized();
    const V3d upInImage = toCamera.cross(right);

    // A camera at p sees v where |(v - p) . right| <= tanX * (p - v) . toCamera, and so upwards.
    // Each of the four edges of the image thus bounds p by the vertex farthest beyond it.
    constexpr double TAN_Y = TAN_HALF_FIELD_OF_VIEW / MARGIN, TAN_X = TAN_Y * DEFAULT_ASPECT;
    constexpr double LOWEST = std::numeric_limits<double>::lowest();
    double rightmost = LOWEST, leftmost = LOWEST, topmost = LOWEST, lowest = LOWEST;
    for (const Triangle& triangle : triangles)
        for (const V3f& vertex : triangle.vertices) {
            const V3d v(vertex);
            const double x = v.dot(right), y = v.dot(upInImage), nearness = v.dot(toCamera);
            rightmost = std::max(rightmost, TAN_X * nearness + x);
            leftmost = std::max(leftmost, TAN_X * nearness - x);
            topmost = std::max(topmost, TAN_Y * nearness + y);
            lowest = std::max(lowest, TAN_Y * nearness - y);
        }
    const double distance =
        std::max((rightmost + leftmost) / (2 * TAN_X), (topmost + lowest) / (2 * TAN_Y));

    Camera camera;
    camera.position = (rightmost - leftmost) / 2 * right + (topmost - lowest) / 2 * upInImage +
                      distance * toCamera;
    camera.direction = -toCamera;
    camera.up = up;
    camera.depth = 1;
    camera.filmSizeY = 2 * TAN_HALF_FIELD_OF_VIEW;
    return camera;
}

}  // namespace bwfirt
