// SPDX-License-Identifier: GPL-3.0-only
#include "app/Progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace bwfirt {

namespace {

constexpr const char* ERASE_LINE = "\r\x1b[K";

}  // namespace

Progress::Progress(int passes) : passes_(passes), isTerminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (isTerminal_)
        std::fputs(ERASE_LINE, stderr);
}

void Progress::show(int passesDone, double raysPerSecond) {
    const Clock::time_point now = Clock::now();
    if (!isTerminal_ || now - lastShown_ < std::chrono::milliseconds(200))
        return;
    lastShown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto left = std::lround(elapsed / passesDone * (passes_ - passesDone));
    std::fprintf(stderr, "%spass %d of %d, %.2f million rays/s, %ld:%02ld:%02ld left", ERASE_LINE,
                 passesDone, passes_, raysPerSecond / 1e6, left / 3600, left / 60 % 60, left % 60);
    std::fflush(stderr);
}

}  // namespace bwfirt
