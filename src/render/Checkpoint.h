// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "film/Film.h"
#include "render/RayCounts.h"
#include "scene/Camera.h"
#include "scene/Scene.h"

#include <filesystem>
#include <string>

namespace bwfirt {

/// What has to be the same for passes to go on where others ended.
struct RunIdentity {
    std::uint64_t scene = 0;   ///< checksum of triangles, lights and reflectance
    std::uint64_t camera = 0;  ///< checksum of all but the reference
    std::uint64_t seed = 0;
    int width = 0;
    int height = 0;
    std::string kernel;         ///< name
    std::string kernelOptions;  ///< in the order in which they were set
    std::string view;           ///< empty for light transport
};

std::uint64_t checksumOf(const Scene& scene);
std::uint64_t checksumOf(const Camera& camera);

/// The sums of a rendering on disk, so that it can go on after an end of any kind and gives the
/// very image that it would have given without that end.
class Checkpoint {
  public:
    Checkpoint(std::filesystem::path path, RunIdentity identity)
        : path_(std::move(path)), identity_(std::move(identity)) {}

    /// Replaces the file as a whole.
    void save(const Film& film, const RayCounts& rays, double secondsRender) const;

    /// Puts what the file holds in the place of its arguments. False where there is no file.
    /// @throws std::runtime_error "<file>: <what is wrong>" where the file is no checkpoint, is
    ///         damaged or is that of another run
    bool load(Film& film, RayCounts& rays, double& secondsRender) const;

  private:
    std::filesystem::path path_;
    RunIdentity identity_;
};

}  // namespace bwfirt
