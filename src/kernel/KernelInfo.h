// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace bwfirt {

/// The kernel that this executable is linked with. SConstruct writes the definition.
struct KernelInfo {
    static const char* const NAME;   ///< of its folder
    static const char* const FLAGS;  ///< that it was compiled with
};

}  // namespace bwfirt
