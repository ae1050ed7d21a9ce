// SPDX-License-Identifier: GPL-3.0-only
#include "test/conformance/Conformance.h"

#include <array>

namespace bwfirt::test {
namespace {

/// Where single precision cannot hold the products of coordinates, any triangle may be the answer,
/// or none, but it has to be an answer.
void expectDefinedAnswers(const Triangles& triangles, double size) {
    const auto kernel = kernelFor(triangles);
    RandomPoints points(V3f(0), size);
    for (int i = 0; i < 1000; ++i) {
        const V3f x = points.next(), y = points.next();
        const auto hit = kernel->kernelIntersectGeometry(towards(x, y));
        kernel->kernelVisibility(x, y);
        if (!hit)
            continue;
        ASSERT_LT(hit->triangle, triangles.size());
        ASSERT_TRUE(hit->distance > 0 && std::isfinite(hit->distance)) << hit->distance;
    }
}

TEST(Triangles, RandomTriangles) {
    std::mt19937 random(1);
    expectRightAnswers(soup(300, 0.3, random), V3f(0), 1.5);
    expectRightAnswers(soup(2000, 0.02, random), V3f(0), 1.2);
    expectRightAnswers(soup(50, 2, random), V3f(0), 3);
}

TEST(Triangles, ClosedMesh) {
    expectRightAnswers(sphere(V3f(1, 2, 3), 1, 4, 0.1), V3f(1, 2, 3), 2);
}

TEST(Triangles, NoOneOrTwoTriangles) {
    const Triangles nothing;
    const auto none = kernelFor(nothing);
    EXPECT_FALSE(none->kernelIntersectGeometry({V3f(0), V3f(1, 0, 0)}));
    EXPECT_TRUE(none->kernelVisibility(V3f(0), V3f(1)));
    std::mt19937 random(2);
    expectRightAnswers(soup(1, 1, random), V3f(0), 2);
    expectRightAnswers(soup(2, 1, random), V3f(0), 2);
}

TEST(Triangles, AllTrianglesIdentical) {
    expectRightAnswers(Triangles(1000, Triangle{{V3f(-1, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)}}),
                       V3f(0), 2, 300);
}

TEST(Triangles, DuplicateAndCoplanarTriangles) {
    expectRightAnswers(joined({grid(), grid(), box(V3f(-3, -3, 0), V3f(3, 3, 2))}), V3f(0), 9);
}

TEST(Triangles, TrianglesWithoutAreaAreNeverHit) {
    std::mt19937 random(3);
    Triangles triangles = soup(200, 0.3, random);
    RandomPoints points(V3f(0), 1);
    for (int i = 0; i < 200; ++i) {
        const V3f a = points.next(), b = points.next();
        triangles.push_back({{a, a, a}});
        triangles.push_back({{a, b, b}});
        triangles.push_back({{a, V3f(0.5F * (a + b)), b}});
    }
    expectRightAnswers(triangles, V3f(0), 1.5);

    Triangles flat;  // exactly on a line, wherever the numbers are rounded
    for (int i = 1; i < 100; ++i)
        flat.push_back({{V3f(0), V3f(i, 0, 0), V3f(2 * i, 0, 0)}});
    const auto kernel = kernelFor(flat);
    for (int i = 1; i < 100; ++i)
        EXPECT_FALSE(kernel->kernelIntersectGeometry({V3f(i, 1, 0), V3f(0, -1, 0)}));
}

TEST(Triangles, NonFiniteTrianglesAreNeverHitAndSpoilNothing) {
    std::mt19937 random(4);
    Triangles triangles = soup(300, 0.3, random);
    const std::array<float, 3> bad = {NOT_A_NUMBER, INFINITE, -INFINITE};
    for (std::size_t i = 0; i < triangles.size(); i += 7)
        triangles[i].vertices[i % 3][static_cast<int>(i % 2)] = bad[i / 7 % 3];
    expectRightAnswers(triangles, V3f(0), 1.5);
    expectRightAnswers(Triangles(9, Triangle{{V3f(NOT_A_NUMBER), V3f(1), V3f(0, 1, 0)}}), V3f(0), 2,
                       100);
}

TEST(Triangles, TinyTriangles) {
    std::mt19937 random(5);
    for (const double scale : {1e-6, 1e-12}) {
        Triangles triangles = soup(300, 0.3, random);
        for (Triangle& triangle : triangles)
            for (V3f& vertex : triangle.vertices)
                vertex = V3f(scale * V3d(vertex));
        expectRightAnswers(triangles, V3f(0), 1.5 * scale);
    }
}

TEST(Triangles, DenormalTrianglesSpoilNothing) {
    std::mt19937 random(17);
    Triangles denormal = soup(300, 1, random);
    for (Triangle& triangle : denormal)
        for (V3f& vertex : triangle.vertices)
            vertex *= 1e-40F;
    expectRightAnswers(joined({soup(300, 0.3, random), denormal}), V3f(0), 1.5);
    expectDefinedAnswers(denormal, 1);
    expectDefinedAnswers(denormal, 1e-40);
}

TEST(Triangles, OneHugeAmongManySmallTriangles) {
    std::mt19937 random(6);
    const Triangles huge = {{{V3f(-1e6F, -2, -1e6F), V3f(1e6F, -2, -1e6F), V3f(0, -2, 1e6F)}}};
    expectRightAnswers(joined({soup(1000, 0.1, random), huge}), V3f(0), 1.5);
}

/// Wherever a builder divides space, it gets few triangles on one side and all others on the other.
TEST(Triangles, EachTwiceAsLargeAndAsFarAwayAsTheLast) {
    std::mt19937 random(8);
    for (const int count : {30, 40}) {
        Triangles triangles = soup(static_cast<std::size_t>(count), 0.5, random);
        double scale = std::ldexp(1.0, -count / 2);
        for (Triangle& triangle : triangles) {
            for (V3f& vertex : triangle.vertices)
                vertex = V3f(scale * (V3d(1) + V3d(vertex)));
            scale *= 2;
        }
        for (int exponent = -count / 2; exponent <= count / 2; exponent += 5)
            expectRightAnswers(triangles, V3f(0), std::ldexp(1.0, exponent), 200);
    }
}

TEST(Triangles, ExtremeCoordinatesGetADefinedAnswer) {
    std::mt19937 random(7);
    for (const float scale : {1e17F, 3e38F, 1e-40F}) {
        Triangles triangles = soup(100, 0.3, random);
        for (Triangle& triangle : triangles)
            triangle.vertices[0] *= scale / 2;
        expectDefinedAnswers(triangles, 1.5);
    }
}

}  // namespace
}  // namespace bwfirt::test
