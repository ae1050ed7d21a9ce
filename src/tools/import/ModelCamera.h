// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Camera.h"

#include <optional>
#include <string>

struct aiScene;

namespace bwfirt {

/// The first perspective camera of the scene, in the coordinates of its root.
/// @param format name of the reader that made the scene
std::optional<Camera> firstCamera(const aiScene& scene, const std::string& format);

}  // namespace bwfirt
