// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

namespace bwfirt {

/// A simple-bvh beside the kernel that this executable is linked with. It comes from a shared
/// library, which the build leaves beside the executables, so that the two cannot share any code:
/// a kernel may well be a changed copy of simple-bvh.
/// @throws std::runtime_error where the library cannot be loaded
std::unique_ptr<RTKernel> createReferenceKernel();

}  // namespace bwfirt
