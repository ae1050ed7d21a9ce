// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"
#include "report/RunReport.h"
#include "report/SystemInfo.h"
#include "scene/Scene.h"

#include <chrono>
#include <memory>

namespace bwfirt {

/// Seconds that a call takes.
template <typename Call>
double secondsOf(const Call& call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A kernel at work on a scene, and the report of it: what rendering and replaying have in common.
class Run {
  public:
    Run(const Settings& settings, std::unique_ptr<RTKernel> kernel);

    const Scene& scene() const { return scene_; }
    const RTKernel& kernel() const { return *kernel_; }

    /// Lets the kernel build its structure, with the threads of the settings.
    void initializeKernel();

    /// Takes down what the kernel's allocators counted, with a warning where the process grew by
    /// much more since the kernel was initialised.
    void measureKernelMemory();

    /// Destroys the kernel, and writes the report where the settings want it and to standard
    /// output.
    void finish();

    RunReport report;

  private:
    const Settings& settings_;
    Scene scene_;
    std::unique_ptr<RTKernel> kernel_;  // destroyed before its triangles
    ProcessMemory before_;
};

}  // namespace bwfirt
