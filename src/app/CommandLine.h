// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"

#include <stdexcept>

namespace bwfirt {

/// The user called the program in a way that it does not know. Exit status 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Reads the command line and sets the kernel's options. Nothing where --help or --version was
/// asked for and has been answered on standard output.
/// @throws UsageError
std::optional<Settings> parseCommandLine(int argc, const char* const* argv, RTKernel& kernel);

}  // namespace bwfirt
