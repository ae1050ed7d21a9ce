// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Simd4.h"
#include "math/Random.h"
#include "math/Vector.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace bwfirt {

/// Numbers of several paths side by side, one path a lane.
constexpr std::size_t LANES = Doubles4::size();
using V3Lanes = Vec3<Doubles4>;
using Bits4 = std::experimental::simd<std::uint64_t,
                                      std::experimental::simd_abi::deduce_t<std::uint64_t, LANES>>;
using RandomLanes = RandomOf<Bits4, Doubles4>;

/// Lane by lane, the number get(lane).
template <typename Numbers, typename Get>
[[gnu::always_inline]] inline Numbers gather(const Get& get) {
    return Numbers([&](auto lane) { return typename Numbers::value_type(get(lane)); });
}

/// Lane by lane, the vector get(lane).
template <typename Get>
[[gnu::always_inline]] inline V3Lanes gatherV3d(const Get& get) {
    return {gather<Doubles4>([&](std::size_t lane) { return get(lane).x; }),
            gather<Doubles4>([&](std::size_t lane) { return get(lane).y; }),
            gather<Doubles4>([&](std::size_t lane) { return get(lane).z; })};
}
template <typename Get>
[[gnu::always_inline]] inline V3Lanes gatherV3f(const Get& get) {
    using std::experimental::static_simd_cast;
    const auto x = gather<Floats4>([&](std::size_t lane) { return get(lane).x; });
    const auto y = gather<Floats4>([&](std::size_t lane) { return get(lane).y; });
    const auto z = gather<Floats4>([&](std::size_t lane) { return get(lane).z; });
    return {static_simd_cast<Doubles4>(x), static_simd_cast<Doubles4>(y),
            static_simd_cast<Doubles4>(z)};
}

/// The vectors of all lanes, in single precision.
[[gnu::always_inline]] inline std::array<V3f, LANES> scatterV3f(const V3Lanes& v) {
    using std::experimental::static_simd_cast;
    const auto x = static_simd_cast<Floats4>(v.x);
    const auto y = static_simd_cast<Floats4>(v.y);
    const auto z = static_simd_cast<Floats4>(v.z);
    std::array<V3f, LANES> vectors;
    for (std::size_t lane = 0; lane < LANES; ++lane)
        vectors[lane] = V3f(x[lane], y[lane], z[lane]);
    return vectors;
}

}  // namespace bwfirt
