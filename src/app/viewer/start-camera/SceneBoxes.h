// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

namespace bwfirt {

/// The bounds, and room on both sides of a scene that is flat: from within nothing is seen of it.
Imath::Box3d spaceOf(const Imath::Box3d& bounds);

/// The box in which most triangles lie, however large the others are: a statue rather than the hall
/// around it. A sample of the triangles tells it.
Imath::Box3d detailsOf(const Scene& scene, const Imath::Box3d& bounds);

/// The box with its largest extent added on each side, as far as it lies within the limits.
Imath::Box3d surroundingsOf(const Imath::Box3d& box, const Imath::Box3d& limits);

}  // namespace bwfirt
