// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace bwfirt::wide {

constexpr int WIDTH = 8;
constexpr const char* INSTRUCTIONS = "AVX2";
constexpr bool HAS_INSTRUCTIONS = true;

using Floats = __m256;
using Ints = __m256i;
using Mask = std::uint32_t;

inline Floats all(float x) {
    return _mm256_set1_ps(x);
}
inline Floats load(const float* numbers) {
    return _mm256_loadu_ps(numbers);
}
inline void store(float* numbers, Floats a) {
    _mm256_storeu_ps(numbers, a);
}
inline Ints load(const std::uint32_t* numbers) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
}
inline void store(std::uint32_t* numbers, Ints a) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(numbers), a);
}
inline Ints loadBytes(const std::uint8_t* bytes) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes)));
}
inline Floats permute(Floats a, Ints lanes) {
    return _mm256_permutevar8x32_ps(a, lanes);
}
inline Ints permute(Ints a, Ints lanes) {
    return _mm256_permutevar8x32_epi32(a, lanes);
}
inline Ints shiftRight(Ints a, std::uint32_t bits) {
    return _mm256_srl_epi32(a, _mm_cvtsi32_si128(static_cast<int>(bits)));
}

inline Floats multiplyAdd(Floats a, Floats b, Floats c) {
    return _mm256_fmadd_ps(a, b, c);
}
inline Floats multiplySubtract(Floats a, Floats b, Floats c) {
    return _mm256_fmsub_ps(a, b, c);
}
inline Floats subtractProduct(Floats a, Floats b, Floats c) {
    return _mm256_fnmadd_ps(b, c, a);
}
inline Floats lesser(Floats a, Floats b) {
    return _mm256_min_ps(a, b);
}
inline Floats greater(Floats a, Floats b) {
    return _mm256_max_ps(a, b);
}
inline Floats absolute(Floats a) {
    return _mm256_andnot_ps(all(-0.0F), a);
}
inline Floats greatestAbsolute(Floats a, Floats b) {
    return greater(absolute(a), absolute(b));
}
inline Floats timesSign(Floats a, Floats other) {
    return _mm256_xor_ps(a, _mm256_and_ps(other, all(-0.0F)));
}

inline Mask maskOf(Floats a) {
    return static_cast<Mask>(_mm256_movemask_ps(a));
}
inline Mask isLess(Floats a, Floats b) {
    return maskOf(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}
inline Mask isLessOrEqual(Floats a, Floats b) {
    return maskOf(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}
inline Mask isNotLess(Floats a, Floats b) {
    return maskOf(_mm256_cmp_ps(a, b, _CMP_NLT_UQ));
}

/// Sixteen bits each: one instruction finds the least and its lane, which becomes bits 16 to 18.
using Keys = __m128i;

inline Keys noKeys() {
    return _mm_set1_epi32(-1);
}
inline Keys keysOf(Floats numbers, Mask mask) {
    const Ints bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const Ints others = _mm256_cmpeq_epi32(
        _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bits), _mm256_setzero_si256());
    const Ints halves =
        _mm256_srli_epi32(_mm256_or_si256(_mm256_castps_si256(numbers), others), 16);
    return _mm_packus_epi32(_mm256_castsi256_si128(halves), _mm256_extracti128_si256(halves, 1));
}
inline std::int32_t least(Keys keys) {
    return _mm_cvtsi128_si32(_mm_minpos_epu16(keys));
}
inline std::size_t laneOf(std::int32_t key) {
    return static_cast<std::size_t>(key >> 16);
}
inline bool isBeyond(std::int32_t key, float x) {
    return (key & 0xffff) > std::bit_cast<std::int32_t>(x) >> 16;
}
inline Keys without(Keys keys, std::size_t lane) {
    static constexpr std::array<std::uint16_t, 15> ONE = {0, 0, 0, 0, 0, 0, 0, 0xffff};
    return _mm_or_si128(keys,
                        _mm_loadu_si128(reinterpret_cast<const __m128i*>(&ONE[WIDTH - 1 - lane])));
}
inline bool isAnyKeyLeft(Keys keys) {
    return _mm_test_all_ones(keys) == 0;
}

inline Mask topBits(const std::uint32_t* numbers) {
    return maskOf(load(reinterpret_cast<const float*>(numbers)));
}
/// The lanes that a mask chooses, from the lowest on.
inline Ints chosenLanes(Mask mask) {
    static constexpr auto LANES = [] {
        std::array<std::array<std::uint8_t, WIDTH>, 1 << WIDTH> lanes{};
        for (Mask chosen = 0; chosen < lanes.size(); ++chosen) {
            std::size_t count = 0;
            for (Mask left = chosen; left != 0; left &= left - 1)
                lanes[chosen][count++] = static_cast<std::uint8_t>(std::countr_zero(left));
        }
        return lanes;
    }();
    return loadBytes(LANES[mask].data());
}
inline void storeChosen(std::uint32_t* target, Mask mask, Ints a) {
    store(target, permute(a, chosenLanes(mask)));
}
inline void storeChosen(float* target, Mask mask, Floats a) {
    store(target, permute(a, chosenLanes(mask)));
}

}  // namespace bwfirt::wide
