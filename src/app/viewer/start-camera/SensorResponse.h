// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "scene/Camera.h"
#include "scene/Scene.h"

namespace bwfirt {

/// The sensorResponse, a power of two, with which a picture by this camera is neither dark nor
/// glaring: it brings the middle of its pixels, of those that get light, to a medium brightness. 1
/// where the scene has no lights, or the picture no light. A thousand paths tell it.
double fittingSensorResponse(const Scene& scene, const RTKernel& kernel, const Camera& camera);

}  // namespace bwfirt
