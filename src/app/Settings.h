// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "render/FalseColour.h"
#include "render/Replay.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bwfirt {

/// What the user asked for on the command line.
struct Settings {
    std::filesystem::path scene;
    std::filesystem::path camera;  ///< empty: the viewer's default camera
    bool batch = false;
    int threads = 1;
    int passes = 100;  ///< in the viewer, unless it is given, as many as there can be
    int width = 640;
    int height = 480;
    std::uint64_t seed = 1;
    int inFlight = 1;
    std::optional<View> view;          ///< nothing: light transport
    std::string viewName;              ///< as on the command line
    std::filesystem::path output;      ///< empty: no images
    std::filesystem::path report;      ///< empty: no JSON
    std::filesystem::path checkpoint;  ///< empty: none
    bool reference = false;            ///< the camera file gets the average intensity
    std::filesystem::path record;      ///< empty: no rays are recorded
    std::uint64_t raysToRecord = 2000000;
    std::filesystem::path replay;  ///< empty: no rays are replayed
    double secondsPerMeasurement = Replay::SECONDS_PER_MEASUREMENT;  ///< of replaying
    std::optional<std::uint64_t> only;  ///< index of a single ray to replay
    std::vector<std::pair<std::string, std::string>> kernelOptions;
};

}  // namespace bwfirt
