// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/LaneKeys.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace bwfirt::wide {

constexpr int WIDTH = 8;
constexpr const char* INSTRUCTIONS = "no instructions of its own";
constexpr bool HAS_INSTRUCTIONS = false;

using Mask = std::uint32_t;

template <typename Number>
struct Numbers {
    std::array<Number, WIDTH> lanes;
};
using Floats = Numbers<float>;
using Ints = Numbers<std::uint32_t>;

/// The result of a function of each lane's number.
template <typename Function>
auto perLane(const Function& function) {
    Numbers<decltype(function(std::size_t{0}))> result;
    for (std::size_t i = 0; i < WIDTH; ++i)
        result.lanes[i] = function(i);
    return result;
}
template <typename Function>
Mask maskOf(const Function& function) {
    Mask mask = 0;
    for (std::size_t i = 0; i < WIDTH; ++i)
        mask |= static_cast<Mask>(function(i)) << i;
    return mask;
}

inline Floats all(float x) {
    return perLane([&](std::size_t) { return x; });
}
template <typename Number>
Numbers<Number> load(const Number* numbers) {
    return perLane([&](std::size_t i) { return numbers[i]; });
}
inline void store(float* numbers, const Floats& a) {
    std::copy(a.lanes.begin(), a.lanes.end(), numbers);
}
inline Ints loadBytes(const std::uint8_t* bytes) {
    return perLane([&](std::size_t i) { return std::uint32_t{bytes[i]}; });
}
template <typename Number>
Numbers<Number> permute(const Numbers<Number>& a, const Ints& lanes) {
    return perLane([&](std::size_t i) { return a.lanes[lanes.lanes[i] % WIDTH]; });
}
inline Ints shiftRight(const Ints& a, std::uint32_t bits) {
    return perLane([&](std::size_t i) { return a.lanes[i] >> bits; });
}

inline Floats operator+(const Floats& a, const Floats& b) {
    return perLane([&](std::size_t i) { return a.lanes[i] + b.lanes[i]; });
}
inline Floats operator-(const Floats& a, const Floats& b) {
    return perLane([&](std::size_t i) { return a.lanes[i] - b.lanes[i]; });
}
inline Floats operator*(const Floats& a, const Floats& b) {
    return perLane([&](std::size_t i) { return a.lanes[i] * b.lanes[i]; });
}
inline Floats operator-(const Floats& a) {
    return perLane([&](std::size_t i) { return -a.lanes[i]; });
}
inline Floats multiplyAdd(const Floats& a, const Floats& b, const Floats& c) {
    return a * b + c;
}
inline Floats multiplySubtract(const Floats& a, const Floats& b, const Floats& c) {
    return a * b - c;
}
inline Floats subtractProduct(const Floats& a, const Floats& b, const Floats& c) {
    return a - b * c;
}
inline Floats lesser(const Floats& a, const Floats& b) {
    return perLane(
        [&](std::size_t i) { return a.lanes[i] < b.lanes[i] ? a.lanes[i] : b.lanes[i]; });
}
inline Floats greater(const Floats& a, const Floats& b) {
    return perLane(
        [&](std::size_t i) { return a.lanes[i] > b.lanes[i] ? a.lanes[i] : b.lanes[i]; });
}
inline Floats absolute(const Floats& a) {
    return perLane([&](std::size_t i) { return std::abs(a.lanes[i]); });
}
inline Floats greatestAbsolute(const Floats& a, const Floats& b) {
    return greater(absolute(a), absolute(b));
}
inline Floats timesSign(const Floats& a, const Floats& other) {
    return perLane(
        [&](std::size_t i) { return std::signbit(other.lanes[i]) ? -a.lanes[i] : a.lanes[i]; });
}

inline Mask isLess(const Floats& a, const Floats& b) {
    return maskOf([&](std::size_t i) { return a.lanes[i] < b.lanes[i]; });
}
inline Mask isLessOrEqual(const Floats& a, const Floats& b) {
    return maskOf([&](std::size_t i) { return a.lanes[i] <= b.lanes[i]; });
}
inline Mask isNotLess(const Floats& a, const Floats& b) {
    return maskOf([&](std::size_t i) { return !(a.lanes[i] < b.lanes[i]); });
}

using Keys = Numbers<std::int32_t>;

inline Keys noKeys() {
    return perLane([](std::size_t) { return NO_KEY; });
}
inline Keys keysOf(const Floats& numbers, Mask mask) {
    return perLane([&](std::size_t i) {
        const auto bits = std::bit_cast<std::int32_t>(numbers.lanes[i]) & ~LANE_BITS;
        return (mask >> i & 1) != 0 ? bits | static_cast<std::int32_t>(i) : NO_KEY;
    });
}
inline std::int32_t least(const Keys& keys) {
    return *std::min_element(keys.lanes.begin(), keys.lanes.end());
}
inline Keys without(Keys keys, std::size_t lane) {
    keys.lanes[lane] = NO_KEY;
    return keys;
}
inline bool isAnyKeyLeft(const Keys& keys) {
    return least(keys) != NO_KEY;
}

inline Mask topBits(const std::uint32_t* numbers) {
    return maskOf([&](std::size_t i) { return numbers[i] >> 31 != 0; });
}
template <typename Number>
void storeChosen(Number* target, Mask mask, const Numbers<Number>& a) {
    for (; mask != 0; mask &= mask - 1)
        *target++ = a.lanes[static_cast<std::size_t>(std::countr_zero(mask))];
}

}  // namespace bwfirt::wide
