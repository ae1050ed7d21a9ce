// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "render/FalseColour.h"

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
    int passes = 100;
    int width = 640;
    int height = 480;
    std::uint64_t seed = 1;
    int inFlight = 1;
    std::optional<View> view;      ///< nothing: light transport
    std::string viewName;          ///< as on the command line
    std::filesystem::path output;  ///< empty: no images
    std::filesystem::path report;  ///< empty: no JSON
    std::vector<std::pair<std::string, std::string>> kernelOptions;
};

}  // namespace bwfirt
