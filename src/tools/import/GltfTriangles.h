// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <filesystem>

namespace bwfirt {

/// How many triangles the meshes of a glTF 2.0 or GLB file announce, each mesh counted once; 0
/// where the file is something else. The reader of assimp leaves out, without a word, triangles
/// that refer to vertices that are not there.
std::uint64_t announcedGltfTriangles(const std::filesystem::path& path);

}  // namespace bwfirt
