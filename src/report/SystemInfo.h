// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <string>

namespace bwfirt {

/// The machine that a run was made on.
struct SystemInfo {
    std::string cpu;
    int cores = 0;             ///< processors of the machine
    int threadsAvailable = 0;  ///< processors that this process may use
    std::uint64_t memoryBytes = 0;
    std::string os;
    std::string date;  ///< now, ISO 8601 in UTC
};

/// What cannot be found out is an empty string or 0.
SystemInfo systemInfo();

/// Processors that this process may use.
int threadsAvailable();

/// Memory of this process in bytes: resident now, and the most that ever was (VmHWM).
struct ProcessMemory {
    std::uint64_t bytesNow = 0;
    std::uint64_t bytesPeak = 0;
};
ProcessMemory processMemory();

}  // namespace bwfirt
