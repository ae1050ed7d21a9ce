// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "scene/Camera.h"
#include "scene/Scene.h"

namespace bwfirt {

Camera startCamera(const Scene& scene, const RTKernel& kernel);

}  // namespace bwfirt
