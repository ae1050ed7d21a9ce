// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

namespace bwfirt {

/// A square perpendicular to the up axis, in the coordinates of the model.
struct SquareLight {
    V3d centre;
    double size;      ///< length of its edges
    double exitance;  ///< radiant exitance
};

/// What the user asked for on the command line.
struct ImportSettings {
    std::filesystem::path model;
    std::filesystem::path base;   ///< BASE.ra2, BASE.camera and BASE.scene are written
    std::optional<double> scale;  ///< nothing: as placementFor() finds it
    std::optional<V3d> up;        ///< nothing: as the file tells
    std::vector<SquareLight> lights;
};

/// A wrong command line.
struct ImportUsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Nothing where --help or --version has been answered.
/// @throws ImportUsageError
std::optional<ImportSettings> parseImportCommandLine(int argc, const char* const* argv);

}  // namespace bwfirt
