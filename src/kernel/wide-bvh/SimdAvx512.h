// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/LaneKeys.h"

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace bwfirt::wide {

constexpr int WIDTH = 16;
constexpr const char* INSTRUCTIONS = "AVX-512";
constexpr bool HAS_INSTRUCTIONS = true;

using Floats = __m512;
using Ints = __m512i;
using Mask = std::uint32_t;

inline Floats all(float x) {
    return _mm512_set1_ps(x);
}
inline Floats load(const float* numbers) {
    return _mm512_loadu_ps(numbers);
}
inline void store(float* numbers, Floats a) {
    _mm512_storeu_ps(numbers, a);
}
inline Ints load(const std::uint32_t* numbers) {
    return _mm512_loadu_si512(numbers);
}
inline Ints loadBytes(const std::uint8_t* bytes) {
    return _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)));
}
inline Floats permute(Floats a, Ints lanes) {
    return _mm512_permutexvar_ps(lanes, a);
}
inline Ints permute(Ints a, Ints lanes) {
    return _mm512_permutexvar_epi32(lanes, a);
}
inline Ints shiftRight(Ints a, std::uint32_t bits) {
    return _mm512_srl_epi32(a, _mm_cvtsi32_si128(static_cast<int>(bits)));
}

inline Floats multiplyAdd(Floats a, Floats b, Floats c) {
    return _mm512_fmadd_ps(a, b, c);
}
inline Floats multiplySubtract(Floats a, Floats b, Floats c) {
    return _mm512_fmsub_ps(a, b, c);
}
inline Floats subtractProduct(Floats a, Floats b, Floats c) {
    return _mm512_fnmadd_ps(b, c, a);
}
inline Floats absolute(Floats a) {
    return _mm512_abs_ps(a);
}
inline Floats greatestAbsolute(Floats a, Floats b) {
    return _mm512_range_ps(a, b, 0b1011);
}
inline Floats timesSign(Floats a, Floats other) {
    return _mm512_xor_ps(a, _mm512_and_ps(other, all(-0.0F)));
}

inline Floats lesser(Floats a, Floats b) {
    return _mm512_min_ps(a, b);
}
inline Floats greater(Floats a, Floats b) {
    return _mm512_max_ps(a, b);
}
inline Mask isLess(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
inline Mask isLessOrEqual(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
inline Mask isNotLess(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_NLT_UQ);
}

using Keys = Ints;

inline Keys noKeys() {
    return _mm512_set1_epi32(NO_KEY);
}
inline Keys keysOf(Floats numbers, Mask mask) {
    const Ints lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const Ints cleared =
        _mm512_andnot_si512(_mm512_set1_epi32(LANE_BITS), _mm512_castps_si512(numbers));
    return _mm512_mask_or_epi32(noKeys(), static_cast<__mmask16>(mask), cleared, lanes);
}
inline std::int32_t least(Keys keys) {
    return _mm512_reduce_min_epi32(keys);
}
inline Keys without(Keys keys, std::size_t lane) {
    return _mm512_mask_mov_epi32(keys, static_cast<__mmask16>(1U << lane), noKeys());
}
inline bool isAnyKeyLeft(Keys keys) {
    return _mm512_cmpneq_epi32_mask(keys, noKeys()) != 0;
}

inline Mask topBits(const std::uint32_t* numbers) {
    return _mm512_movepi32_mask(_mm512_loadu_si512(numbers));
}
inline void storeChosen(std::uint32_t* target, Mask mask, Ints a) {
    _mm512_storeu_si512(target, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), a));
}
inline void storeChosen(float* target, Mask mask, Floats a) {
    store(target, _mm512_maskz_compress_ps(static_cast<__mmask16>(mask), a));
}

}  // namespace bwfirt::wide
