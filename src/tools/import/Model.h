// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Camera.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bwfirt {

/// What counts of a material: how it emits.
struct Material {
    std::string name;
    double radiance = 0;      ///< luminance of the emissive colour
    bool hasTexture = false;  ///< an image, which is not read, tells where it emits
};

/// A file as assimp reads it, in the file's own coordinates. Damaged files crash assimp or keep it
/// busy for ever: a model is to be made inside runApart(), whose process a time limit ends.
class Model {
  public:
    using Corners = std::array<V3d, 3>;

    /// @throws std::runtime_error "<path>: <what is wrong>"
    explicit Model(const std::filesystem::path& path);
    ~Model();

    /// Calls for all triangles of all instances, in the order of the file's nodes, with the index
    /// of a material. Transformed in double precision.
    /// @throws std::runtime_error where a face refers to a vertex that is not there
    void forEachTriangle(const std::function<void(const Corners&, std::size_t)>& visit) const;

    const std::vector<Material>& materials() const { return materials_; }

    /// The first perspective camera.
    const std::optional<Camera>& camera() const { return camera_; }

    /// The axis that the file calls up; y where it does not tell.
    const V3d& up() const { return up_; }

    /// Name of the format.
    const std::string& format() const { return format_; }

    /// How many points and lines there are, of which forEachTriangle tells nothing.
    std::size_t pointsAndLines() const;

    /// How many lights without a surface there are: points, directions, cones.
    std::size_t lightSources() const;

    /// What assimp complained of, a line each.
    const std::vector<std::string>& complaints() const { return complaints_; }

  private:
    struct Import;

    std::string path_;
    std::unique_ptr<Import> import_;
    std::vector<Material> materials_;
    std::optional<Camera> camera_;
    V3d up_{0, 1, 0};
    std::string format_;
    std::vector<std::string> complaints_;
};

}  // namespace bwfirt
