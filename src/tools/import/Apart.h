// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace bwfirt {

/// From now on an interrupt (SIGINT, SIGTERM, SIGHUP) only ends what runs apart.
void holdInterrupts();

/// Runs work in a process of its own and returns the text that it returned. What the work writes to
/// standard output or standard error is lost. It is ended when it wants more memory than is left,
/// and by an interrupt. To be called from the only thread of a process, once.
/// @throws std::runtime_error with the message of the exception that ended the work, or
///         "<name>: <how it died>"
std::string runApart(const std::string& name, const std::function<std::string()>& work);

/// Ends the process when it has used so many seconds of processor time more. Called again, it
/// begins anew.
void limitProcessorTime(std::uint64_t seconds);

void liftProcessorTimeLimit();

}  // namespace bwfirt
