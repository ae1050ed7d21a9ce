// SPDX-License-Identifier: GPL-3.0-only
#include "math/Sampling.h"

#include "test/Statistics.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace bwfirt {
namespace {

using test::fits;

constexpr int SAMPLES = 200000;
constexpr std::size_t BINS = 20;

std::size_t bin(double value) {
    return static_cast<std::size_t>(value * BINS);
}

TEST(Random, NumbersAreUniform) {
    Random random(1);
    std::vector<std::size_t> counts(BINS), first(BINS), second(BINS);
    for (int i = 0; i < SAMPLES; ++i) {
        ++counts.at(bin(random.uniform()));
        const auto [u, v] = random.uniformSquare();
        ++first.at(bin(u));
        ++second.at(bin(v));
    }
    const std::vector<double> uniform(BINS, 1.0 / BINS);
    EXPECT_TRUE(fits(counts, uniform));
    EXPECT_TRUE(fits(first, uniform));
    EXPECT_TRUE(fits(second, uniform));
}

TEST(Random, TheSquareIsUniformInBothCoordinatesTogether) {
    Random random(2);
    std::vector<std::size_t> counts(BINS * BINS);
    for (int i = 0; i < SAMPLES; ++i) {
        const auto [u, v] = random.uniformSquare();
        ++counts.at(bin(u) * BINS + bin(v));
    }
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

TEST(Random, NeighbouringSeedsGiveIndependentFirstNumbers) {
    std::vector<std::size_t> counts(BINS * BINS);
    for (std::uint64_t seed = 0; seed < SAMPLES; ++seed)
        ++counts.at(bin(Random(seed).uniform()) * BINS + bin(Random(seed + 1).uniform()));
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

class CosineHemisphere : public testing::TestWithParam<V3d> {};

TEST_P(CosineHemisphere, HasUnitLengthAboveTheSurface) {
    const V3d normal = GetParam().normalized();
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const V3d direction = sampleCosineHemisphere(normal, random);
        EXPECT_NEAR(direction.length(), 1, 1e-12);
        EXPECT_GE(direction.dot(normal), 0);
    }
}

// The density cos(theta) / pi makes sin^2(theta) and the azimuth uniform.
TEST_P(CosineHemisphere, HasCosineDensity) {
    const V3d normal = GetParam().normalized();
    const V3d helper = std::abs(normal.x) < 0.5 ? V3d(1, 0, 0) : V3d(0, 1, 0);
    const V3d tangent = normal.cross(helper).normalized(), bitangent = normal.cross(tangent);
    Random random(4);
    std::vector<std::size_t> counts(BINS * BINS);
    for (int i = 0; i < SAMPLES; ++i) {
        const V3d direction = sampleCosineHemisphere(normal, random);
        const double x = direction.dot(tangent), y = direction.dot(bitangent);
        const double azimuth = std::atan2(y, x) / (2 * std::numbers::pi) + 0.5;
        ++counts.at(bin(std::min(x * x + y * y, 1 - 1e-9)) * BINS +
                    bin(std::min(azimuth, 1 - 1e-9)));
    }
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

INSTANTIATE_TEST_SUITE_P(Normals, CosineHemisphere,
                         testing::Values(V3d(0, 0, 1), V3d(0, 0, -1), V3d(1, 0, 0), V3d(0, -1, 0),
                                         V3d(1, -2, 3), V3d(-1, 1e-9, -1e-9)));

// Barycentric coordinates of uniform points: u = 1 - sqrt(1 - i/n) halves have equal areas, so
// (1 - u)^2 and v / (1 - u) are uniform in the unit square.
TEST(SampleTriangle, IsUniformInArea) {
    const V3d a(1, 2, 3), ab(4, 0, -1), ac(-1, 2, 5);
    Random random(5);
    std::vector<std::size_t> counts(BINS * BINS);
    for (int i = 0; i < SAMPLES; ++i) {
        const V3d p = sampleTriangle(a, a + ab, a + ac, random) - a;
        const double bb = ab.dot(ab), bc = ab.dot(ac), cc = ac.dot(ac);
        const double determinant = bb * cc - bc * bc;
        const double u = (cc * p.dot(ab) - bc * p.dot(ac)) / determinant;
        const double v = (bb * p.dot(ac) - bc * p.dot(ab)) / determinant;
        ASSERT_NEAR((p - u * ab - v * ac).length(), 0, 1e-9);
        const double first = std::clamp((1 - u) * (1 - u), 0.0, 1 - 1e-9);
        const double second = std::clamp(v / (1 - u), 0.0, 1 - 1e-9);
        ++counts.at(bin(first) * BINS + bin(second));
    }
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

}  // namespace
}  // namespace bwfirt
