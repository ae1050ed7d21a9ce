// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Triangle.h"

#include <Imath/ImathBox.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace bwfirt {

/// A range of triangles that emits from both sides. Its radiance is exitance / pi.
struct Light {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< inclusive
    double exitance = 0;     ///< radiant exitance, not negative

    bool operator==(const Light&) const = default;
};

/// Every surface is Lambertian on both sides with the same reflectance.
struct Scene {
    std::string trianglesPath;  ///< as it stands in the scene file, relative to that file
    std::vector<Triangle> triangles;
    std::vector<Light> lights;
    double reflectance = 0.7;  ///< in [0, 1)
};

/// Reads a scene file and the triangles that it names.
/// @throws std::runtime_error "<file>:<line>: <key>: <what was expected>" for a bad scene file,
///         "<file>: <what is wrong>" for bad triangles
Scene readScene(const std::filesystem::path& path);

/// Writes the scene file, not its triangles. Read again it gives the same scene to the bit. The
/// lines of the comment come first.
void writeScene(const std::filesystem::path& path, const Scene& scene,
                const std::string& comment = "");

/// The lights as they stand in a scene file.
std::string lightsText(const std::vector<Light>& lights);

/// Replaces the lights in a scene file, or appends them; the rest stays as it is, comments too.
/// @throws std::runtime_error where readScene finds the file's text wrong
void writeLights(const std::filesystem::path& path, const std::vector<Light>& lights);

/// Reads `*.ra2`: little endian float32, nine per triangle, no header.
/// @throws std::runtime_error where the size is not a multiple of 36 bytes or exceeds the memory
std::vector<Triangle> readTriangles(const std::filesystem::path& path);

void writeTriangles(const std::filesystem::path& path, const std::vector<Triangle>& triangles);

/// The box around all finite triangles; the origin where there are none.
Imath::Box3d boundsOf(const Scene& scene);

/// One sentence for each property of the scene that makes its results doubtful.
std::vector<std::string> sceneWarnings(const Scene& scene);

}  // namespace bwfirt
