// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

namespace bwfirt {

/// The same bits as another type. std::bit_cast refuses vectors for which a processor has no
/// registers.
template <typename To, typename From>
To sameBits(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(static_cast<void*>(&to), static_cast<const void*>(&from), sizeof(To));
    return to;
}

/// The random numbers of one path: SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom
/// number generators", OOPSLA 2014). Eight bytes of state, so that each path can own its generator.
/// Or those of several paths at once, where Bits and Number hold several numbers.
template <typename Bits, typename Number>
class RandomOf {
  public:
    /// A seed, or the state of another generator, whose numbers then go on.
    explicit RandomOf(const Bits& seed) : state_(seed) {}

    const Bits& state() const { return state_; }

    /// Uniform in [0, 1), a multiple of 2^-53.
    Number uniform() {
        const Bits z = next();
        return numberOf(z >> 32) * 0x1p-32 + numberOf((z & 0xffffffff) >> 11) * 0x1p-53;
    }

    /// Uniform in the square [0, 1)^2, multiples of 2^-32: the two halves of one random number.
    std::pair<Number, Number> uniformSquare() {
        const Bits z = next();
        return {numberOf(z >> 32) * 0x1p-32, numberOf(z & 0xffffffff) * 0x1p-32};
    }

    /// The last `numbers` numbers, 0 or 1, are to be drawn once more.
    void stepBack(const Bits& numbers) { state_ -= -numbers & STEP; }

  private:
    static constexpr std::uint64_t STEP = 0x9e3779b97f4a7c15;

    Bits next() {
        state_ += STEP;
        Bits z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }

    /// Of bits below 2^32. They are the last bits of a number between 2^52 and 2^53.
    static Number numberOf(const Bits& bits) {
        return sameBits<Number>(bits | sameBits<std::uint64_t>(0x1p52)) - 0x1p52;
    }

    Bits state_;
};

using Random = RandomOf<std::uint64_t, double>;

}  // namespace bwfirt
