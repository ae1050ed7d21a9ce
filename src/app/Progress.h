// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <chrono>

namespace bwfirt {

/// A line on standard error that tells how far a run is and when it ends; silent where standard
/// error is no terminal.
class Progress {
  public:
    explicit Progress(int passes);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// @param raysPerSecond so far
    void show(int passesDone, double raysPerSecond);

  private:
    using Clock = std::chrono::steady_clock;

    int passes_;
    bool isTerminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastShown_{};
};

}  // namespace bwfirt
