// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "scene/Camera.h"
#include "scene/Scene.h"

namespace bwfirt {

/// The camera with which the viewer opens a scene when it is given none. It stands within the
/// scene's bounding box (beside a scene that is flat), upright, and looks where geometry fills the
/// picture: far enough from it, and rich in detail.
///
/// It tries places and directions by a few thousand queries of the kernel, which has been
/// initialised with the scene's triangles. The answer depends on the scene and the kernel's answers
/// alone, and is a valid camera for every scene, an empty one too.
Camera startCamera(const Scene& scene, const RTKernel& kernel);

}  // namespace bwfirt
