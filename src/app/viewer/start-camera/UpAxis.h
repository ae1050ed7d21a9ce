// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

namespace bwfirt {

/// The axis that points upwards in the scene, 0, 1 or 2 for x, y or z. Triangle files do not tell
/// it: some modelling programs have y upwards, others z.
///
/// Floors, ceilings and table tops make most of the surface that is perpendicular to an axis, and
/// what stands in a room stands on its floor. So it is the axis with the largest such surface,
/// where the lower half of the scene counts more. y where the scene does not tell.
int upAxis(const Scene& scene);

}  // namespace bwfirt
