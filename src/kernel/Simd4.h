// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <experimental/simd>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // on how calls pass vectors: all functions are inlined
#endif

namespace bwfirt {

/// Four numbers that an instruction of the processor computes at once, where it has such. With
/// clang 14, assignment through where() does nothing.
using Doubles4 = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4>>;
using Floats4 = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

/// The same as vectors of the compiler, whose lanes can change places.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// Of each two numbers the lesser; the second where one is a NaN.
template <typename Vector>
[[gnu::always_inline]] inline Vector lesser(const Vector& a, const Vector& b) {
    return a < b ? a : b;
}
/// Of each two numbers the greater; the second where one is a NaN.
template <typename Vector>
[[gnu::always_inline]] inline Vector greater(const Vector& a, const Vector& b) {
    return a > b ? a : b;
}

}  // namespace bwfirt
