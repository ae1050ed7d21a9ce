// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace bwfirt {

/// The points origin + t * direction, t > 0, prepared for tests against boxes.
struct BoxRay {
    V3d origin;
    V3d direction;
    V3d inverse = V3d(1) / direction;  ///< infinite where the direction is 0
};

/// An axis-aligned box.
struct Box {
    V3d low{std::numeric_limits<double>::infinity()};
    V3d high{-std::numeric_limits<double>::infinity()};

    void extend(const V3d& point) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    }

    /// Makes the box larger on all sides by far more than the rounding errors of the triangle test,
    /// and far less than a step of single precision: what the triangle test finds just beside a
    /// triangle must not be lost at the triangle's box.
    void pad() {
        const V3d size = high - low;
        const double margin = 1e-12 * std::max({size.x, size.y, size.z});
        low -= V3d(margin);
        high += V3d(margin);
    }

    /// The t at which the ray enters the box, 0 where it starts inside; nothing where it misses the
    /// box or enters it beyond `tMax`.
    std::optional<double> enter(const BoxRay& ray, double tMax) const {
        double near = 0;
        double far = tMax;
        for (int axis = 0; axis < 3; ++axis) {
            if (ray.direction[axis] == 0) {
                const double position = ray.origin[axis];
                if (!(position >= low[axis] && position <= high[axis]))
                    return std::nullopt;
                continue;
            }
            const double tLow = (low[axis] - ray.origin[axis]) * ray.inverse[axis];
            const double tHigh = (high[axis] - ray.origin[axis]) * ray.inverse[axis];
            near = std::max(near, std::min(tLow, tHigh));
            far = std::min(far, std::max(tLow, tHigh));
        }
        // The bounds carry the rounding errors of three operations each (Ize: "Robust BVH ray
        // traversal", JCGT 2(2), 2013).
        constexpr double SLACK = 1 + 16 * std::numeric_limits<double>::epsilon();
        if (!(near <= far * SLACK))
            return std::nullopt;
        return std::min(near, far);
    }
};

}  // namespace bwfirt
