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

// Images depend on these bits: the numbers are those of the SplitMix64 of Java and of Vigna.
TEST(Random, IsSplitMix64) {
    Random random(1234567);
    EXPECT_EQ(random.uniform(), static_cast<double>(6457827717110365317U >> 11) * 0x1p-53);
    const auto [u, v] = random.uniformSquare();
    EXPECT_EQ(u, static_cast<double>(3203168211198807973U >> 32) * 0x1p-32);
    EXPECT_EQ(v, static_cast<double>(3203168211198807973U & 0xffffffff) * 0x1p-32);
}

class CosineHemisphere : public testing::TestWithParam<V3d> {};

TEST_P(CosineHemisphere, HasUnitLengthAboveTheSurface) {
    const V3d normal = GetParam().normalized();
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const auto [x, y] = sampleDisc(random);
        const V3d direction = cosineHemisphere(normal, x, y);
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
        const auto [x, y] = sampleDisc(random);
        const V3d direction = cosineHemisphere(normal, x, y);
        const double u = direction.dot(tangent), v = direction.dot(bitangent);
        const double azimuth = std::atan2(v, u) / (2 * std::numbers::pi) + 0.5;
        ++counts.at(bin(std::min(u * u + v * v, 1 - 1e-9)) * BINS +
                    bin(std::min(azimuth, 1 - 1e-9)));
    }
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

INSTANTIATE_TEST_SUITE_P(Normals, CosineHemisphere,
                         testing::Values(V3d(0, 0, 1), V3d(0, 0, -1), V3d(1, 0, 0), V3d(0, -1, 0),
                                         V3d(1, -2, 3), V3d(-1, 1e-9, -1e-9)));

// Barycentric coordinates of uniform points: u = 1 - sqrt(1 - i/n) halves have equal areas, so
// (1 - u)^2 and v / (1 - u) are uniform in the unit square.
TEST(PointOfTriangle, IsUniformInArea) {
    const V3d a(1, 2, 3), ab(4, 0, -1), ac(-1, 2, 5);
    Random random(5);
    std::vector<std::size_t> counts(BINS * BINS);
    for (int i = 0; i < SAMPLES; ++i) {
        const auto [first, second] = random.uniformSquare();
        const V3d p = pointOfTriangle(a, ab, ac - ab, first, second) - a;
        const double bb = ab.dot(ab), bc = ab.dot(ac), cc = ac.dot(ac);
        const double determinant = bb * cc - bc * bc;
        const double u = (cc * p.dot(ab) - bc * p.dot(ac)) / determinant;
        const double v = (bb * p.dot(ac) - bc * p.dot(ab)) / determinant;
        ASSERT_NEAR((p - u * ab - v * ac).length(), 0, 1e-9);
        const double one = std::clamp((1 - u) * (1 - u), 0.0, 1 - 1e-9);
        const double other = std::clamp(v / (1 - u), 0.0, 1 - 1e-9);
        ++counts.at(bin(one) * BINS + bin(other));
    }
    EXPECT_TRUE(fits(counts, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS))));
}

}  // namespace
}  // namespace bwfirt
