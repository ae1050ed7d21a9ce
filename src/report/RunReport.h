// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/KernelOption.h"
#include "math/Vector.h"
#include "render/RayCounts.h"
#include "render/Replay.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bwfirt {

/// The measurements of one run. Times are wall-clock seconds, memory is in bytes.
struct RunReport {
    std::vector<KernelOption> kernelOptions;  ///< those that the user set
    std::string kernelDescription;            ///< what the kernel says of itself; often empty
    std::string scene;
    std::string camera;
    std::string view;  ///< of a false-colour image; empty for light transport
    std::uint64_t triangles = 0;
    int threads = 0;
    int inFlight = 0;
    int passes = 0;
    int width = 0;
    int height = 0;
    std::uint64_t seed = 0;

    double secondsLoad = 0;
    double secondsInitialize = 0;
    double secondsRender = 0;

    RayCounts rays;

    std::uint64_t kernelBytesPeak = 0;
    std::uint64_t kernelBytesFinal = 0;   ///< after rendering
    std::uint64_t kernelBytesLeaked = 0;  ///< after the kernel was destroyed
    std::uint64_t processBytesPeak = 0;
    std::uint64_t trianglesBytes = 0;

    V3d averageIntensity{0};
    V3d standardError{0};  ///< NaN after a single pass
    std::optional<V3d> referenceAverageIntensity;

    std::optional<ReplayResult> replay;

    std::vector<std::string> warnings;

    double secondsTotal() const { return secondsInitialize + secondsRender; }
    double raysPerSecond() const {
        return static_cast<double>(rays.intersect + rays.visibility) / secondsRender;
    }

    /// |average - reference|^2, or |average|^2 without a reference.
    double squaredError() const {
        const V3d error = averageIntensity - referenceAverageIntensity.value_or(V3d(0));
        return error.dot(error);
    }
};

/// The report with its build and the machine it was made on, as JSON (doc/file-formats).
std::string reportAsJson(const RunReport& report);

/// The same for people.
std::string reportAsText(const RunReport& report);

}  // namespace bwfirt
