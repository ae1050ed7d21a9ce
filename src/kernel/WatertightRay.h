// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <optional>

namespace bwfirt {

/// The points origin + t * direction, t > 0, prepared for tests against triangles in double
/// precision. The direction may have any length. Kernels that use this test differ from each other
/// in nothing but their acceleration structures.
///
/// The test is that of Woop, Benthin and Wald: "Watertight ray/triangle intersection", JCGT 2(1),
/// 2013. It sees the triangle from the ray's origin, sheared such that the ray runs along an axis;
/// the ray meets the triangle where it passes all three edges on the same side. Both triangles at
/// a shared edge compute it from the same numbers, up to the sign, so that no ray passes between
/// them. That holds as long as the compiler does not fuse a product with the sum that follows:
/// SConstruct says -ffp-contract=off.
class WatertightRay {
  public:
    WatertightRay(const V3d& origin, const V3d& direction)
        : origin_(origin), direction_(direction) {
        const V3d size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
        kz_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        kx_ = (kz_ + 1) % 3;
        ky_ = (kz_ + 2) % 3;
        shearX_ = direction[kx_] / direction[kz_];
        shearY_ = direction[ky_] / direction[kz_];
        originX_ = origin[kx_];
        originY_ = origin[ky_];
        originZ_ = origin[kz_];
        directionZ_ = direction[kz_];
    }

    const V3d& origin() const { return origin_; }
    const V3d& direction() const { return direction_; }

    /// The t in (0, infinity) at which the ray meets the triangle, from either side. Nothing for a
    /// ray in the triangle's plane, and wherever a NaN takes part.
    std::optional<double> intersect(const Triangle& triangle) const {
        const auto& [a, b, c] = triangle.vertices;
        const double az = a[kz_] - originZ_, bz = b[kz_] - originZ_, cz = c[kz_] - originZ_;
        const double ax = a[kx_] - originX_ - shearX_ * az, ay = a[ky_] - originY_ - shearY_ * az;
        const double bx = b[kx_] - originX_ - shearX_ * bz, by = b[ky_] - originY_ - shearY_ * bz;
        const double cx = c[kx_] - originX_ - shearX_ * cz, cy = c[ky_] - originY_ - shearY_ * cz;

        const double u = cx * by - cy * bx;
        const double v = ax * cy - ay * cx;
        const double w = bx * ay - by * ax;
        const double least = std::min(std::min(u, v), w), most = std::max(std::max(u, v), w);
        const double determinant = u + v + w;
        if (((least < 0) & (most > 0)) | (determinant == 0))
            return std::nullopt;

        const double z = (u * az + v * bz + w * cz) / determinant;
        const double t = z / directionZ_;
        if (!(t > 0))
            return std::nullopt;
        return t;
    }

  private:
    V3d origin_;
    V3d direction_;
    int kx_, ky_, kz_;                    ///< axes, kz_ that of the direction's largest component
    double originX_, originY_, originZ_;  ///< along those axes
    double directionZ_;
    double shearX_, shearY_;
};

}  // namespace bwfirt
