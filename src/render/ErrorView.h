// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "render/Difference.h"
#include "render/PathTracer.h"

#include <array>
#include <atomic>

namespace bwfirt {

/// Asks a reference every question that the path tracer asks the kernel, and shows the pixels whose
/// paths met a wrong answer, over a dim grey image of what the camera sees: red for a hit that was
/// missed or lies on a wrong triangle, yellow for one where there is none, cyan for a wrong
/// visibility.
class ErrorView : public Integrator {
  public:
    /// @param shade the grey image below the errors; all must outlive the view
    ErrorView(const PathTracer& pathTracer, const Integrator& shade, const RTKernel& reference)
        : pathTracer_(pathTracer), shade_(shade), reference_(reference) {}

    void trace(std::span<Sample> samples, RayCounts& counts) const override;

    /// Answers so far that differed, by Difference.
    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> differences() const;

  private:
    const PathTracer& pathTracer_;
    const Integrator& shade_;
    const RTKernel& reference_;
    mutable std::array<std::atomic<std::uint64_t>, DIFFERENCE_NAMES.size()> differences_{};
};

}  // namespace bwfirt
