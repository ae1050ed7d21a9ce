// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"
#include "render/RayCounts.h"

#include <cstdint>
#include <span>

namespace bwfirt {

/// One sample of a pixel: the pixel and the seed of all its random numbers before it is traced, its
/// value afterwards.
struct Sample {
    int x = 0;
    int y = 0;
    std::uint64_t seed = 0;
    V3d value;  ///< linear RGB
};

/// What the renderer shows: light transport or a false colour.
class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Gives each sample its value, which depends on nothing but the sample's pixel and seed and
    /// the kernel's answers, and adds up the queries. Called from many threads at once.
    virtual void trace(std::span<Sample> samples, RayCounts& counts) const = 0;
};

}  // namespace bwfirt
