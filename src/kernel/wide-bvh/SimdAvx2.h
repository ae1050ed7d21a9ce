// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace bwfirt::wide {

constexpr int WIDTH = 8;
constexpr const char* INSTRUCTIONS = "AVX2";

using Floats = __m256;
using Ints = __m256i;
using Mask = std::uint32_t;

inline Floats all(float x) {
    return _mm256_set1_ps(x);
}
inline Floats load(const float* numbers) {
    return _mm256_loadu_ps(numbers);
}
inline Ints loadBytes(const std::uint8_t* bytes) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes)));
}
inline Floats permute(Floats a, Ints lanes) {
    return _mm256_permutevar8x32_ps(a, lanes);
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

inline Ints lanes() {
    return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}
inline Ints noKeys() {
    return _mm256_set1_epi32(NO_KEY);
}
inline Ints keysOf(Floats numbers, Mask mask) {
    const Ints cleared =
        _mm256_andnot_si256(_mm256_set1_epi32(LANE_BITS), _mm256_castps_si256(numbers));
    const Ints bits = _mm256_sllv_epi32(_mm256_set1_epi32(1), lanes());
    const Ints chosen =
        _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bits), bits);
    return _mm256_blendv_epi8(noKeys(), _mm256_or_si256(cleared, lanes()), chosen);
}
inline std::int32_t least(Ints keys) {
    __m128i half = _mm_min_epi32(_mm256_castsi256_si128(keys), _mm256_extracti128_si256(keys, 1));
    half = _mm_min_epi32(half, _mm_shuffle_epi32(half, 0b01001110));
    half = _mm_min_epi32(half, _mm_shuffle_epi32(half, 0b10110001));
    return _mm_cvtsi128_si32(half);
}
inline Ints without(Ints keys, int lane) {
    return _mm256_blendv_epi8(keys, noKeys(), _mm256_cmpeq_epi32(lanes(), _mm256_set1_epi32(lane)));
}
inline bool isAnyKeyLeft(Ints keys) {
    return _mm256_movemask_epi8(_mm256_cmpeq_epi32(keys, noKeys())) != -1;
}

inline Mask topBits(const std::uint32_t* numbers) {
    return maskOf(load(reinterpret_cast<const float*>(numbers)));
}
inline void storeChosen(std::uint32_t* target, Mask mask, const std::uint32_t* numbers) {
    for (; mask != 0; mask &= mask - 1)
        *target++ = numbers[std::countr_zero(mask)];
}

}  // namespace bwfirt::wide
