// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <experimental/simd>

namespace bwfirt {

/// Four numbers that an instruction of the processor computes at once, where it has such. With
/// clang 14, assignment through where() does nothing.
using Doubles4 = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4>>;
using Floats4 = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

}  // namespace bwfirt
