// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Scene.h"

namespace bwfirt {

Imath::Box3d boundsOf(const Scene& scene) {
    Imath::Box3d bounds;
    for (const Triangle& triangle : scene.triangles)
        if (isFinite(triangle))
            for (const V3f& vertex : triangle.vertices)
                bounds.extendBy(V3d(vertex));
    return bounds.isEmpty() ? Imath::Box3d(V3d(0)) : bounds;
}

}  // namespace bwfirt
