// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Camera.h"
#include "scene/Scene.h"
#include "tools/import/Placement.h"
#include "tools/import/Settings.h"

namespace bwfirt {

class Model;

/// What becomes of a model.
struct Conversion {
    Scene scene;                          ///< without the path of its triangles
    std::vector<std::string> lightNames;  ///< of each light: where it comes from
    Camera camera;
    bool hasCameraOfFile = false;  ///< else the camera frames the model
    Placement placement;
    Imath::Box3d modelBox;  ///< of all triangles, in the model's coordinates
    V3d up;
};

/// All triangles that do not emit come first, in the file's order; then those of each emissive
/// material, so that each is one light; then the square lights.
/// @throws std::runtime_error "<model>: <what is wrong>"
Conversion converted(const Model& model, const ImportSettings& settings);

}  // namespace bwfirt
