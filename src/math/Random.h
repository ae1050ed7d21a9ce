// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <utility>

namespace bwfirt {

/// The random numbers of one path: SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom
/// number generators", OOPSLA 2014). Eight bytes of state, so that each path can own its generator.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

    /// Uniform in the square [0, 1)^2, multiples of 2^-32: the two halves of one random number.
    std::pair<double, double> uniformSquare() {
        const std::uint64_t z = next();
        return {static_cast<double>(z >> 32) * 0x1p-32,
                static_cast<double>(z & 0xffffffff) * 0x1p-32};
    }

  private:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

}  // namespace bwfirt
