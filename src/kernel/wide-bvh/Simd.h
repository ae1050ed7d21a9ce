// SPDX-License-Identifier: GPL-3.0-only
#pragma once

// What the kernel asks of the processor: `Floats` and `Ints` are WIDTH numbers side by side, a
// `Mask` has a bit for each. One of three headers is compiled, as the build's `arch` has it; all of
// them define the same:
//
//   WIDTH, INSTRUCTIONS         how many numbers, and the name of what computes them
//   HAS_INSTRUCTIONS            whether anything computes them at once
//
//   all(x), load(numbers)       the same number in all lanes; WIDTH numbers from memory
//   store(numbers, a)           to memory
//   loadBytes(bytes)            WIDTH bytes as Ints; may read 16
//   permute(a, lanes)           of each of the lanes that are named, the number in it; of a lane
//                               the lowest bits count
//   shiftRight(a, bits)         of Ints; zeros come in
//   + - * and unary -           of Floats, rounded each
//   multiplyAdd(a, b, c)        a * b + c, rounded once where there is an instruction for it
//   multiplySubtract(a, b, c)   a * b - c, likewise
//   subtractProduct(a, b, c)    a - b * c, likewise
//   lesser(a, b), greater(a, b) where one of them is NaN, it is b
//   absolute(a), greatestAbsolute(a, b)
//   timesSign(a, other)         a, negated where `other` is negative
//   isLess, isLessOrEqual       a Mask; false where one of them is NaN
//   isNotLess(a, b)             the contrary of isLess
//
//   keysOf(numbers, mask)       keys to sort numbers not below 0 by: their upper bits; where the
//                               mask has no bit, a key that is greater than all of these
//   noKeys(), least(keys), without(keys, lane), isAnyKeyLeft(keys)
//   laneOf(key)                 of the least key
//   isBeyond(key, x)            whether the number of the least key is greater than x; false where
//                               their upper bits are the same
//
//   topBits(numbers)            the top bits of WIDTH whole numbers in memory
//   storeChosen(target, mask, a)
//                               stores those that the mask chooses, one behind the other; writes
//                               WIDTH numbers at most, whatever stands behind those that are chosen

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "kernel/wide-bvh/SimdAvx512.h"  // IWYU pragma: export
#elif defined(__AVX2__) && defined(__FMA__)
#include "kernel/wide-bvh/SimdAvx2.h"  // IWYU pragma: export
#else
#include "kernel/wide-bvh/SimdPlain.h"  // IWYU pragma: export
#endif

namespace bwfirt::wide {

/// Whether nodes are so wide that branches cost more than the work that they save.
constexpr bool HAS_WIDE_REGISTERS = WIDTH > 8;

}  // namespace bwfirt::wide
