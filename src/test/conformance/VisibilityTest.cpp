// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelInfo.h"
#include "test/conformance/Conformance.h"

namespace bwfirt::test {
namespace {

/// Triangles in a cube [-1.5, 1.5]^3, some on their own and some in meshes.
Triangles scene() {
    std::mt19937 random(15);
    return joined(
        {soup(200, 0.3, random), sphere(V3f(0.1F), 0.6, 2, 0.1), box(V3f(-1.4F), V3f(1.3F), 3)});
}

/// Asks isConsistent(kernel, x, y) for segments between points in space and on surfaces. Where a
/// segment passes an edge too closely for single precision, two answers may contradict each other;
/// of random segments, less than one in a thousand does.
template <typename IsConsistent>
void expectConsistency(const char* what, const IsConsistent& isConsistent) {
    constexpr int QUERIES = 40000;
    const Triangles triangles = scene();
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    std::mt19937 random(16);
    RandomPoints points(V3f(0), 1.5);
    const auto pointOnSurface = [&] {
        const Triangle& triangle = triangles[random() % triangles.size()];
        return movedOff(triangle, pointInside(triangle, random), random() % 2 == 0 ? 1 : -1);
    };
    int contradictions = 0;
    for (int i = 0; i < QUERIES; ++i) {
        const V3f x = i % 4 < 2 ? points.next() : pointOnSurface();
        const V3f y = i % 2 < 1 ? points.next() : pointOnSurface();
        if (isConsistent(*kernel, x, y))
            continue;
        ++contradictions;
        ASSERT_TRUE(oracle.accepts(x, y, true)) << "between " << x << " and " << y;
        ASSERT_TRUE(oracle.accepts(x, y, false)) << "between " << x << " and " << y;
    }
    std::printf("%s: of %d segments, %d %s\n", KernelInfo::NAME, QUERIES, contradictions, what);
    EXPECT_LT(contradictions, QUERIES / 1000);
}

TEST(Visibility, IsSymmetric) {
    expectConsistency("free from one end only",
                      [](const RTKernel& kernel, const V3f& x, const V3f& y) {
                          return kernel.kernelVisibility(x, y) == kernel.kernelVisibility(y, x);
                      });
}

TEST(Visibility, AgreesWithTheNearestHit) {
    expectConsistency("that h and V disagree about",
                      [](const RTKernel& kernel, const V3f& x, const V3f& y) {
                          const auto hit = kernel.kernelIntersectGeometry(towards(x, y));
                          const bool isFree = !hit || hit->distance >= (V3d(y) - V3d(x)).length();
                          return kernel.kernelVisibility(x, y) == isFree;
                      });
}

TEST(Visibility, ReachesPointsBeforeANearestHitAndNoneBehindIt) {
    const Triangles triangles = scene();
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    RandomPoints points(V3f(0), 1.5);
    for (int i = 0; i < 2000; ++i) {
        const V3f x = points.next();
        const Ray ray = towards(x, points.next());
        const auto hit = kernel->kernelIntersectGeometry(ray);
        if (!hit)
            continue;
        const Triangle& triangle = triangles[hit->triangle];
        const V3d direction(ray.direction);
        const V3d point = V3d(x) + static_cast<double>(hit->distance) * direction;
        const double side = unitNormal(triangle).dot(direction) < 0 ? 1 : -1;
        for (const V3f& y : {movedOff(triangle, point, side), movedOff(triangle, point, -side)})
            ASSERT_TRUE(oracle.accepts(x, y, kernel->kernelVisibility(x, y)))
                << "between " << x << " and " << y;
    }
}

TEST(Visibility, TrianglesAtTheEndsDoNotBlock) {
    // Powers of two, so that no kernel has to round.
    const Triangles triangles =
        joined({grid(), quad(V3f(0, 0, 4), V3f(8, 0, 4), V3f(8, 8, 4), V3f(0, 8, 4))});
    const auto kernel = kernelFor(triangles);
    const V3f low(2.5F, 3.25F, 0), high(2.5F, 3.25F, 4), above(2.5F, 3.25F, 8);
    EXPECT_TRUE(kernel->kernelVisibility(low, high));
    EXPECT_TRUE(kernel->kernelVisibility(high, low));
    EXPECT_TRUE(kernel->kernelVisibility(high, above));
    EXPECT_FALSE(kernel->kernelVisibility(low, above));
    EXPECT_FALSE(kernel->kernelVisibility(above, low));
}

}  // namespace
}  // namespace bwfirt::test
