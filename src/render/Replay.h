// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "render/Difference.h"
#include "render/RayStream.h"

#include <string>
#include <vector>

namespace bwfirt {

/// How often a kernel answers a stream's questions per second: the median of several measurements,
/// each of which takes as many whole sweeps of the questions as fill the time that was asked for.
struct Rate {
    double perSecond = 0;
    std::vector<double> measurements;  ///< all of them, in the order in which they were made
};

struct ReplayAnswers {
    static constexpr std::size_t EXAMPLES = 3;

    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> counts{};  ///< by Difference
    /// The first records of each difference, by their index in the stream.
    std::array<std::vector<std::uint64_t>, DIFFERENCE_NAMES.size()> examples;
    /// |distance - recorded| / recorded, the largest over hits of the recorded triangle.
    double maxRelativeDistanceError = 0;
};

/// Bounces from the first to the last, inclusive.
struct Bounces {
    int first = 0;
    int last = 0;
};

/// The questions of some bounces of all paths.
struct BounceRate {
    Bounces bounces;
    RayCounts counts;
    Rate mixed;
};

struct ReplayResult {
    std::string recordedBy;            ///< a kernel
    double secondsPerMeasurement = 0;  ///< that each measurement takes at least
    RayCounts counts;
    Rate intersect;      ///< h alone
    Rate visibility;     ///< V alone
    Rate mixed;          ///< h and V in the recorded order
    int inFlight = 0;    ///< questions at once for the next rate
    Rate mixedInFlight;  ///< h and V, many questions at once
    std::vector<BounceRate> byBounce;
    ReplayAnswers answers;          ///< to single questions
    ReplayAnswers answersInFlight;  ///< to many questions at once
};

/// Asks a kernel the questions of a stream, without the renderer.
class Replay {
  public:
    /// Shorter measurements tell more of the machine's noise than of a kernel.
    static constexpr double SECONDS_PER_MEASUREMENT = 1;

    /// Questions at once where the user has not said how many.
    static constexpr int IN_FLIGHT = 16;

    /// @param inFlight 1 or more questions at once for mixedInFlight and answersInFlight; all other
    ///        rates and answers are those of single questions
    /// @param secondsPerMeasurement that each measurement of a rate takes at least
    Replay(const RTKernel& kernel, const RayStream& stream, int threads, int inFlight,
           double secondsPerMeasurement = SECONDS_PER_MEASUREMENT)
        : kernel_(kernel),
          stream_(stream),
          threads_(threads),
          inFlight_(inFlight),
          secondsPerMeasurement_(secondsPerMeasurement) {}

    /// All rates, then all answers. Takes the time of about 28 measurements, longer where a sweep
    /// of the stream takes longer than one of them should.
    ReplayResult run() const;

    /// @param inFlight 1 or more questions at once
    ReplayAnswers compareAnswers(int inFlight) const;

  private:
    const RTKernel& kernel_;
    const RayStream& stream_;
    int threads_;
    int inFlight_;
    double secondsPerMeasurement_;
};

}  // namespace bwfirt
