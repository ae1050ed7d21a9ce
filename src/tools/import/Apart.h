// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace bwfirt {

/// What work in a process of its own may use up before it is ended.
struct Limits {
    std::uintmax_t memoryBytes;
    std::uint64_t processorSeconds;
};

/// Runs work in a process of its own and returns the text that it returned. What the work writes to
/// standard output or standard error is lost. An interrupt ends it. To be called from the only
/// thread of a process, once.
/// @throws std::runtime_error with the message of the exception that ended the work, or
///         "<name>: <how it died>"
std::string runApart(const std::string& name, const Limits& limits,
                     const std::function<std::string()>& work);

}  // namespace bwfirt
