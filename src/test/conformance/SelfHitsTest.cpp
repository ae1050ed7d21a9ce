// SPDX-License-Identifier: GPL-3.0-only
#include "test/conformance/Conformance.h"

// Rays and segments from points that are moved off a surface by NORMAL_OFFSET, as the renderer
// does. No triangle may be hit from behind, and none may hide a point on its own side.

namespace bwfirt::test {
namespace {

constexpr int QUERIES = 20000;

/// A direction in the hemisphere about the normal, every other one close to the surface.
V3f leaving(const V3d& normal, const V3d& anywhere, bool isGrazing) {
    const double cosTheta = normal.dot(anywhere);
    const V3d alongSurface = anywhere - cosTheta * normal;
    const double height = (isGrazing ? 1e-3 : 1) * std::abs(cosTheta);
    return V3f((alongSurface + height * normal).normalized());
}

void expectNoSelfHits(const Triangles& triangles) {
    const auto kernel = kernelFor(triangles);
    std::mt19937 random(12);
    RandomPoints directions(V3f(0), 1);
    int selfHits = 0;
    for (int i = 0; i < QUERIES; ++i) {
        const std::size_t start = random() % triangles.size();
        const Triangle& triangle = triangles[start];
        const double side = i % 2 == 0 ? 1 : -1;
        const V3f origin = movedOff(triangle, pointInside(triangle, random), side);
        const V3d normal = side * unitNormal(triangle);
        const auto hit = kernel->kernelIntersectGeometry(
            {origin, leaving(normal, V3d(directions.next()), i % 4 < 2)});
        selfHits += hit && hit->triangle == start ? 1 : 0;
    }
    EXPECT_EQ(selfHits, 0) << "of " << QUERIES << " rays";
}

TEST(SelfHits, NoRayHitsTheTriangleThatItLeaves) {
    std::mt19937 random(13);
    expectNoSelfHits(soup(300, 0.3, random));
    expectNoSelfHits(box(V3f(-3, 1, 2), V3f(5, 8, 7), 7));
    expectNoSelfHits(sphere(V3f(11, -7, 3), 2, 3, 0.1));
    // As large as a scene may be before the renderer warns of the offset.
    expectNoSelfHits(sphere(V3f(20, -10, 5), 90, 3, 0.1));
}

void expectFreeViewInside(const Triangles& convexMesh, const V3f& centre) {
    const auto kernel = kernelFor(convexMesh);
    std::mt19937 random(14);
    const auto pointOnInnerSide = [&] {
        const Triangle& triangle = convexMesh[random() % convexMesh.size()];
        const V3d point = pointInside(triangle, random);
        const bool isInside = unitNormal(triangle).dot(V3d(centre) - point) > 0;
        return movedOff(triangle, point, isInside ? 1 : -1);
    };
    int hidden = 0;
    for (int i = 0; i < QUERIES; ++i) {
        const V3f x = pointOnInnerSide(), y = pointOnInnerSide();
        hidden += kernel->kernelVisibility(x, y) ? 0 : 1;
    }
    EXPECT_EQ(hidden, 0) << "of " << QUERIES << " pairs";
}

TEST(SelfHits, PointsOnTheInnerSideOfAConvexMeshSeeEachOther) {
    expectFreeViewInside(box(V3f(-3, 1, 2), V3f(5, 8, 7), 7), V3f(1, 4, 4));
    expectFreeViewInside(sphere(V3f(11, -7, 3), 8, 3, 0), V3f(11, -7, 3));
}

}  // namespace
}  // namespace bwfirt::test
