// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace bwfirt {

/// A setting of a kernel, which the user changes with --kernel-option NAME=VALUE.
struct KernelOption {
    std::string name;
    std::string value;    ///< in force now; the default before anybody has set it
    std::string meaning;  ///< one line for --help: what it does and which values it takes
};

}  // namespace bwfirt
