// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/StartCamera.h"

namespace bwfirt {

Camera startCamera(const Scene& scene, const RTKernel&) {
    Camera camera;
    camera.position = boundsOf(scene).center();
    return camera;
}

}  // namespace bwfirt
