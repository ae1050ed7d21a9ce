// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"

namespace bwfirt {

namespace {

/// The simplest right kernel: it asks every triangle.
class YourKernel : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override { triangles_ = triangles; }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const WatertightRay watertightRay(V3d(ray.origin), V3d(ray.direction));
        std::optional<Hit> nearest;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const std::optional<double> t = watertightRay.intersect(triangles_[i]);
            if (!t || !hasArea(triangles_[i]))
                continue;
            const auto distance = static_cast<float>(*t);
            if (distance > 0 && std::isfinite(distance) &&
                (!nearest || distance < nearest->distance))
                nearest = Hit{distance, i};
        }
        return nearest;
    }

    // kernelVisibility is not overridden: it asks kernelIntersectGeometry.

  private:
    std::span<const Triangle> triangles_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<YourKernel>();
}

}  // namespace bwfirt
