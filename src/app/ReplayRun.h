// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"

#include <memory>

namespace bwfirt {

/// Asks the kernel the rays of a recorded stream, without the renderer: measures, compares the
/// answers with the recorded ones and reports, or asks a single ray and prints both answers.
/// @throws std::exception where the run failed
void runReplay(const Settings& settings, std::unique_ptr<RTKernel> kernel);

}  // namespace bwfirt
