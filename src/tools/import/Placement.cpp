// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Placement.h"

#include "scene/TextReader.h"

#include <algorithm>

namespace bwfirt {

namespace {

constexpr double LARGEST_COORDINATE = 100;

double largestComponent(const V3d& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

Placement placementFor(const Imath::Box3d& model, std::optional<double> scale) {
    if (scale)
        return {*scale, V3d(0)};
    Placement placement;
    if (largestComponent(model.center()) > largestComponent(model.size()))
        placement.origin = model.center();
    const double largest = std::max(largestComponent(model.min - placement.origin),
                                    largestComponent(model.max - placement.origin));
    if (largest > 0)
        placement.factor = std::exp2(std::floor(std::log2(LARGEST_COORDINATE / largest)));
    return placement;
}

std::string formula(const Placement& placement) {
    const std::string factor = "scene = " + formatNumber(placement.factor) + " * ";
    const V3d& origin = placement.origin;
    if (origin == V3d(0))
        return factor + "model";
    return factor + "(model - (" + formatNumber(origin.x) + ", " + formatNumber(origin.y) + ", " +
           formatNumber(origin.z) + "))";
}

}  // namespace bwfirt
