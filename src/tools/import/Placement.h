// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <Imath/ImathBox.h>

#include <optional>
#include <string>

namespace bwfirt {

/// Where a model stands in its scene: scene = factor * (model - origin).
struct Placement {
    double factor = 1;
    V3d origin{0, 0, 0};

    V3d operator()(const V3d& point) const { return factor * (point - origin); }
};

/// A model is scaled by the power of two that brings its largest |coordinate| to above 50 and not
/// above 100: there NORMAL_OFFSET is many steps of float32 and yet small beside what is modelled,
/// and a power of two rounds no coordinate. Where the model is farther from (0, 0, 0) than it is
/// large, it is moved there first, since scaling alone would leave it small.
///
/// With a scale of the user's own nothing is moved.
Placement placementFor(const Imath::Box3d& model, std::optional<double> scale);

/// "scene = 0.5 * (model - (1, 2, 3))"
std::string formula(const Placement& placement);

}  // namespace bwfirt
