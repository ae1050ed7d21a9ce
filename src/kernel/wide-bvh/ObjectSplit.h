// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/Reference.h"

#include <array>
#include <span>

namespace bwfirt::wide {

/// Sorts references into bins along all three axes, equal steps between the outermost centres.
class CentreBins {
  public:
    /// @param halfCentres box around Reference::halfCentre() of all
    CentreBins(const Box& halfCentres, int count) : origin_(halfCentres.low), count_(count) {
        for (int axis = 0; axis < 3; ++axis) {
            // Where the quotient overflows, the centres are the same as good as.
            const float size = halfCentres.high[axis] - halfCentres.low[axis];
            const float steps = static_cast<float>(count) * 0.9999f / size;
            steps_[axis] = std::isfinite(steps) ? steps : 0;
        }
        steps_[3] = steps_[0];
    }

    std::size_t count() const { return static_cast<std::size_t>(count_); }
    bool areTold(int axis) const { return steps_[axis] > 0; }  ///< whether there is any distance

    /// The bins, along each axis, of the reference.
    Int4 of(const Reference& reference) const {
        return __builtin_convertvector((reference.halfCentre() - origin_) * steps_, Int4);
    }

  private:
    Float4 origin_;
    Float4 steps_;  ///< bins per half unit
    int count_;
};

/// References divided by their centres: those in the bins below `bin` and the others.
struct ObjectSplit {
    float cost = INFINITE;  ///< number times half area of both sides, in the scale of the node
    int axis = 0;
    int bin = 0;
    double overlap = 0;  ///< half area that the boxes of both sides have in common
};

/// What the bins hold.
class CentreCounts {
  public:
    static constexpr int MOST_BINS = 32;

    explicit CentreCounts(const CentreBins& bins);
    void count(std::span<const Reference> references);
    void add(const CentreCounts& other);

    /// The split of least cost by the surface area heuristic.
    ObjectSplit bestSplit(float scale) const;

  private:
    CentreBins bins_;
    std::array<std::array<Box, MOST_BINS>, 3> boxes_;
    std::array<std::array<std::uint32_t, MOST_BINS>, 3> counts_;
};

}  // namespace bwfirt::wide
