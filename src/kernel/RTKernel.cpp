// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"

#include <stdexcept>

namespace bwfirt {

bool RTKernel::kernelVisibility(const V3f& x, const V3f& y) const {
    const V3d segment = V3d(y) - V3d(x);
    const double length = std::sqrt(segment.dot(segment));
    const std::optional<Hit> hit = kernelIntersectGeometry({x, V3f(segment / length)});
    return !hit || hit->distance >= length;
}

void RTKernel::kernelIntersectMany(std::span<const Ray> rays,
                                   std::span<std::optional<Hit>> hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i)
        hits[i] = kernelIntersectGeometry(rays[i]);
}

void RTKernel::kernelVisibleMany(std::span<const Segment> segments, std::span<bool> visible) const {
    for (std::size_t i = 0; i < segments.size(); ++i)
        visible[i] = kernelVisibility(segments[i].x, segments[i].y);
}

void RTKernel::kernelSetOption(std::string_view name, const std::string&) {
    throw std::invalid_argument("unknown kernel option '" + std::string(name) + "'");
}

}  // namespace bwfirt
