// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "film/Film.h"
#include "render/Integrator.h"
#include "render/RayCounts.h"

#include <cstdint>

namespace bwfirt {

/// Renders pass by pass. The threads share a pass tile by tile. A Mersenne Twister seeded from
/// (seed, pass, tile) deals one seed to each pixel, so that an image depends on nothing but the
/// integrator, the seed and the number of passes: any number of threads gives the same bits.
class Renderer {
  public:
    /// Width and height of a tile in pixels; tiles at the right and lower border may be smaller.
    static constexpr int TILE_SIZE = 32;

    /// The integrator must outlive the renderer.
    Renderer(const Integrator& integrator, std::uint64_t seed, int threads)
        : integrator_(integrator), seed_(seed), threads_(threads) {}

    /// Adds the next pass to the film: one sample to each pixel. Returns the queries it took.
    /// @throws what a kernel throws from a query, std::bad_alloc for instance; the film is then of
    ///         no more use
    RayCounts renderPass(Film& film) const;

  private:
    const Integrator& integrator_;
    std::uint64_t seed_;
    int threads_;
};

}  // namespace bwfirt
