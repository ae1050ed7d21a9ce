// SPDX-License-Identifier: GPL-3.0-only
#include "render/Lanes.h"

#include "math/Sampling.h"

#include <gtest/gtest.h>

#include <array>

namespace bwfirt {
namespace {

constexpr std::array<std::uint64_t, LANES> SEEDS = {1, 2, 3, 1ULL << 63};

RandomLanes seeded() {
    return RandomLanes(gather<Bits4>([](std::size_t lane) { return SEEDS[lane]; }));
}

TEST(Lanes, DrawTheNumbersThatEachWouldDrawAlone) {
    RandomLanes random = seeded();
    std::array<Random, LANES> alone = {Random(SEEDS[0]), Random(SEEDS[1]), Random(SEEDS[2]),
                                       Random(SEEDS[3])};
    for (int i = 0; i < 1000; ++i) {
        const Doubles4 number = random.uniform();
        const auto [u, v] = random.uniformSquare();
        const auto [x, y] = sampleDisc(random);
        for (std::size_t lane = 0; lane < LANES; ++lane) {
            EXPECT_EQ(number[lane], alone[lane].uniform());
            EXPECT_EQ(std::pair(double(u[lane]), double(v[lane])), alone[lane].uniformSquare());
            EXPECT_EQ(std::pair(double(x[lane]), double(y[lane])), sampleDisc(alone[lane]));
            EXPECT_EQ(random.state()[lane], alone[lane].state());
        }
    }
}

TEST(Lanes, GiveEachPathTheDirectionThatItWouldGetAlone) {
    RandomLanes random = seeded();
    const std::array<V3d, LANES> normals = {V3d(0, 0, 1), V3d(0, 0, -1), V3d(0.6, 0, -0.8),
                                            V3d(0, -1, 0)};
    const V3Lanes normal = gatherV3d([&](std::size_t lane) { return normals[lane]; });
    for (int i = 0; i < 100; ++i) {
        const auto [x, y] = sampleDisc(random);
        const std::array<V3f, LANES> directions = scatterV3f(cosineHemisphere(normal, x, y));
        for (std::size_t lane = 0; lane < LANES; ++lane)
            EXPECT_EQ(directions[lane],
                      V3f(cosineHemisphere<double>(normals[lane], x[lane], y[lane])));
    }
}

TEST(Lanes, KeepTheOrderOfVectorsInSinglePrecision) {
    const std::array<V3f, LANES> vectors = {V3f(1, 2, 3), V3f(4, 5, 6), V3f(7, 8, 9),
                                            V3f(0.1F, -0.0F, 1e-40F)};
    EXPECT_EQ(scatterV3f(gatherV3f([&](std::size_t lane) { return vectors[lane]; })), vectors);
}

}  // namespace
}  // namespace bwfirt
