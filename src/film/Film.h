// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace bwfirt {

/// What a film holds, to be kept and put back.
struct FilmSums {
    std::vector<V3d> total;         ///< of the finished shards, pixel by pixel
    std::vector<V3d> shard;         ///< of the shard under way
    std::vector<V3d> passAverages;  ///< one a pass
};

/// The sums of all passes over an image, in double precision.
///
/// Sixteen consecutive passes make a shard. A shard is summed from zero in the order of its passes,
/// and finished shards are added to the total in order: a shard that is computed elsewhere, or
/// later, and then added leaves the same bits.
class Film {
  public:
    static constexpr int PASSES_PER_SHARD = 16;

    /// @throws std::runtime_error where the sums exceed the memory that is left
    Film(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    int passes() const { return static_cast<int>(sums_.passAverages.size()); }

    /// Adds a pixel's value to the pass under way. Each pixel gets one value a pass; threads may
    /// add different pixels at the same time.
    void add(int x, int y, const V3d& value) { sums_.shard[index(x, y)] += value; }

    /// Ends the pass under way, in which the pixels had this average.
    void endPass(const V3d& passAverage);

    /// The mean of a pixel over all passes, 0 before the first.
    V3d mean(int x, int y) const;

    /// The mean over all pixels and passes.
    V3d averageIntensity() const;

    /// The standard error of averageIntensity(), from the spread of the passes' averages. NaN
    /// before the second pass.
    V3d standardError() const;

    /// Between two passes.
    const FilmSums& sums() const { return sums_; }

    /// Goes on from the sums of a film of the same size.
    void restore(FilmSums sums) { sums_ = std::move(sums); }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    FilmSums sums_;
};

}  // namespace bwfirt
