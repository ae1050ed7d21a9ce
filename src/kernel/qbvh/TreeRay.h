// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/WatertightRay.h"
#include "kernel/qbvh/Vectors.h"
#include "math/Vector.h"

#include <algorithm>
#include <cmath>

namespace bwfirt {

/// The points origin + t * direction, t > 0, in coordinates of the tree, in which the scene reaches
/// from -1 to 1 and the largest component of the direction is 1. Fourth lanes stay unused.
struct TreeRay {
    Double4 origin{};
    Double4 direction{}, inverse{};
    int axis;             ///< of the direction's largest component
    double tScale;        ///< from t to the distance in the tree
    double moved = 0;     ///< how far the origin is from where the ray starts
    bool isFar = false;   ///< starts too far away for all bounds on errors
    bool misses = false;  ///< all of the scene

    TreeRay(const V3d& start, const V3d& along, double scale) {
        const V3d size(std::abs(along.x), std::abs(along.y), std::abs(along.z));
        axis = longestAxis(size.x, size.y, size.z);
        tScale = scale * size[axis];
        const Double4 components{along.x, along.y, along.z, size[axis]};
        direction = components * (1 / size[axis]);
        inverse = size[axis] / components;
        origin = Double4{start.x, start.y, start.z, 0} * scale;
        if (std::max({std::abs(origin[0]), std::abs(origin[1]), std::abs(origin[2])}) > NEAR)
            moveForward();
    }

    /// From the origin, and no farther than to beyond the scene.
    float distance(double t) const {
        return static_cast<float>(std::min(t * tScale - moved, BEYOND));
    }

    /// Where rays in the tree start.
    static constexpr double NEAR = 2;

    /// More than any distance from there to a point of the scene.
    static constexpr double BEYOND = 4;

  private:
    static constexpr double FARTHEST = 0x1p14;

    /// To where the ray reaches [-NEAR, NEAR] on all axes. From less than FARTHEST that leaves an
    /// error below 2^-38.
    void moveForward() {
        for (int i = 0; i < 3; ++i) {
            const double distance = std::abs(origin[i]);
            isFar |= !(distance < FARTHEST);
            if (distance <= NEAR)
                continue;
            if (origin[i] * direction[i] < 0)
                moved = std::max(moved, (distance - NEAR) / std::abs(direction[i]));
            else
                misses = true;
        }
        isFar |= !(moved < FARTHEST);
        moved = isFar ? 0 : moved;
        origin += moved * direction;
        for (int i = 0; i < 3; ++i)
            misses |= std::abs(origin[i]) > 1.001 * NEAR;
        misses &= !isFar;
    }
};

}  // namespace bwfirt
