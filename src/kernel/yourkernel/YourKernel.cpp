// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"

namespace bwfirt {

namespace {

/// The simplest right kernel: it asks every triangle.
class YourKernel : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override { triangles_ = triangles; }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        std::optional<Hit> nearest;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const std::optional<float> distance = intersect(ray, triangles_[i]);
            if (distance && (!nearest || *distance < nearest->distance))
                nearest = {*distance, i};
        }
        return nearest;
    }

    // kernelVisibility is not overridden: it asks kernelIntersectGeometry.

  private:
    /// Möller and Trumbore: "Fast, minimum storage ray/triangle intersection", 1997, in double
    /// precision and without their epsilon. Comparisons are written such that NaN is a miss.
    static std::optional<float> intersect(const Ray& ray, const Triangle& triangle) {
        const V3d a(triangle.vertices[0]);
        const V3d ab = V3d(triangle.vertices[1]) - a;
        const V3d ac = V3d(triangle.vertices[2]) - a;
        const V3d direction(ray.direction);

        const V3d p = direction.cross(ac);
        const double determinant = ab.dot(p);
        if (determinant == 0)
            return std::nullopt;
        const V3d s = V3d(ray.origin) - a;
        const double u = s.dot(p) / determinant;
        if (!(u >= 0 && u <= 1))
            return std::nullopt;
        const V3d q = s.cross(ab);
        const double v = direction.dot(q) / determinant;
        if (!(v >= 0 && u + v <= 1))
            return std::nullopt;
        const auto distance = static_cast<float>(ac.dot(q) / determinant);
        if (!(distance > 0 && std::isfinite(distance)))
            return std::nullopt;
        return distance;
    }

    std::span<const Triangle> triangles_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<YourKernel>();
}

}  // namespace bwfirt
