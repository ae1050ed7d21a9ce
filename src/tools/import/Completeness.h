// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <filesystem>

namespace bwfirt {

/// Refuses files that end too early, in the formats whose readers do not see it: of a truncated PLY
/// file assimp makes up the rest, of an ASCII STL file it takes what there is.
/// @throws std::runtime_error "<path>: <what is wrong>"
void requireComplete(const std::filesystem::path& path);

}  // namespace bwfirt
