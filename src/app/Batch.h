// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"

#include <memory>

namespace bwfirt {

/// Renders without a window: loads the scene, lets the kernel build, renders all passes, destroys
/// the kernel, then writes images and report. SIGINT and SIGTERM end it after the pass under way,
/// with image and report of the passes done.
/// @throws std::exception where the run failed
void runBatch(const Settings& settings, std::unique_ptr<RTKernel> kernel);

}  // namespace bwfirt
