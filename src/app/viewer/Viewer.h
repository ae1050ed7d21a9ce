// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"

#include <memory>
#include <string>

namespace bwfirt {

// Defined in app/window, or in app/no-window where the build is without SDL.

/// Opens a window and flies through the scene until the user quits.
/// @throws std::runtime_error where there is no display, or the scene cannot be loaded
/// @throws UsageError in a build without the viewer
void runViewer(const Settings& settings, std::unique_ptr<RTKernel> kernel);

/// What --help tells of the viewer.
std::string viewerHelp();

}  // namespace bwfirt
