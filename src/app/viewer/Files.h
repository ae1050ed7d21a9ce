// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

#include <filesystem>

namespace bwfirt {

/// The first of NAME-1.ENDING, NAME-2.ENDING … in the present folder that does not exist yet.
std::filesystem::path newFile(const std::filesystem::path& scene, const std::string& ending);

/// Writes the lights into the scene file, the old one having been copied to NAME.scene.bak, or
/// .bak2 and so on where that exists. Returns the copy.
/// @throws std::exception; the scene file is then as it was, and there is no copy
std::filesystem::path saveLights(const std::filesystem::path& scene,
                                 const std::vector<Light>& lights);

}  // namespace bwfirt
