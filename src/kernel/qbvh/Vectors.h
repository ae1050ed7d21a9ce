// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#ifdef __SSE4_1__
#include <immintrin.h>
#endif

// Numbers side by side, as g++ and clang know them, and what they do not know of the processor.

namespace bwfirt {

using Double4 = double __attribute__((vector_size(32)));
using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline Float4 absolute(const Float4& a) {
    return std::bit_cast<Float4>(std::bit_cast<Int4>(a) & std::numeric_limits<std::int32_t>::max());
}

/// a * b + c, in one step where the processor has that.
[[gnu::always_inline]] inline Float4 multiplyAdd(const Float4& a, const Float4& b,
                                                 const Float4& c) {
#ifdef __FMA__
    return _mm_fmadd_ps(a, b, c);
#else
    return a * b + c;
#endif
}
[[gnu::always_inline]] inline Float8 multiplyAdd(const Float8& a, const Float8& b,
                                                 const Float8& c) {
#ifdef __FMA__
    return _mm256_fmadd_ps(a, b, c);
#else
    return a * b + c;
#endif
}

/// A bit for each lane in which a comparison, which gives -1 or 0, is true.
[[gnu::always_inline]] inline unsigned bitsOf(const Int4& mask) {
#ifdef __SSE4_1__
    return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
    unsigned bits = 0;
    for (int i = 0; i < 4; ++i)
        bits |= mask[i] != 0 ? 1U << i : 0;
    return bits;
#endif
}
[[gnu::always_inline]] inline unsigned bitsOf(const Int8& mask) {
#ifdef __AVX__
    return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(mask)));
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; ++i)
        bits |= mask[i] != 0 ? 1U << i : 0;
    return bits;
#endif
}

template <int LANE>
[[gnu::always_inline]] inline Float4 inAllLanes(const Float4& a) {
    return __builtin_shufflevector(a, a, LANE, LANE, LANE, LANE);
}
[[gnu::always_inline]] inline Float8 inEightLanes(float a) {
    return Float8{a, a, a, a, a, a, a, a};
}

/// 2^(e - 127) for each of the four bytes e of a number, from the lowest on.
[[gnu::always_inline]] inline Float4 powersOf2(std::uint32_t exponents) {
#ifdef __SSE4_1__
    const __m128i bytes = _mm_cvtsi32_si128(static_cast<std::int32_t>(exponents));
    return _mm_castsi128_ps(_mm_slli_epi32(_mm_cvtepu8_epi32(bytes), 23));
#else
    const Int4 bits = static_cast<std::int32_t>(exponents) >> Int4{0, 8, 16, 24} & 255;
    return std::bit_cast<Float4>(bits << 23);
#endif
}

/// Numbers from memory.
[[gnu::always_inline]] inline Float4 load(const std::array<std::uint16_t, 4>& numbers) {
#ifdef __SSE4_1__
    return _mm_cvtepi32_ps(_mm_cvtepu16_epi32(_mm_loadu_si64(numbers.data())));
#else
    return Float4{static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
                  static_cast<float>(numbers[2]), static_cast<float>(numbers[3])};
#endif
}
[[gnu::always_inline]] inline Float8 loadEight(const std::uint8_t* numbers) {
#ifdef __AVX2__
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadu_si64(numbers)));
#else
    Float8 result;
    for (int i = 0; i < 8; ++i)
        result[i] = static_cast<float>(numbers[i]);
    return result;
#endif
}

/// For each choice of four numbers, the bytes of those chosen one behind the other.
constexpr auto BYTES_OF_CHOSEN = [] {
    std::array<std::array<std::uint8_t, 16>, 16> table{};
    for (std::size_t bits = 0; bits < table.size(); ++bits)
        for (std::size_t lane = 0, byte = 0; lane < 4; ++lane)
            for (std::size_t i = 0; i < 4 && (bits >> lane & 1) != 0; ++i)
                table[bits][byte++] = static_cast<std::uint8_t>(4 * lane + i);
    return table;
}();

/// Writes those of four numbers that the bits choose one behind the other; behind them may stand
/// anything, up to four numbers in all.
[[gnu::always_inline]] inline void storeChosen(std::uint32_t* target, unsigned bits,
                                               const Int4& numbers) {
#ifdef __SSE4_1__
    const __m128i bytes =
        _mm_loadu_si128(reinterpret_cast<const __m128i*>(BYTES_OF_CHOSEN[bits].data()));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(target),
                     _mm_shuffle_epi8(std::bit_cast<__m128i>(numbers), bytes));
#else
    for (; bits != 0; bits &= bits - 1)
        *target++ = static_cast<std::uint32_t>(numbers[std::countr_zero(bits)]);
#endif
}

}  // namespace bwfirt
