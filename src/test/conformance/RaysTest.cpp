// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelInfo.h"
#include "test/conformance/Conformance.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace bwfirt::test {
namespace {

TEST(Rays, AxisParallelRaysWithEitherSignOfZero) {
    // All coordinates are small whole numbers: rays run through vertices, along edges and within
    // planes of the tree, and every product is exact.
    Triangles triangles =
        joined({box(V3f(-2), V3f(2), 4), box(V3f(-1), V3f(1)), box(V3f(0), V3f(1, 2, 1))});
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            for (const float zero : {0.0F, -0.0F}) {
                V3f direction(zero);
                direction[axis] = sign;
                RandomPoints points(V3f(0), 3);
                for (int i = 0; i < 300; ++i) {
                    V3f origin = points.next();
                    if (i % 2 == 0)
                        for (int k = 0; k < 3; ++k)
                            origin[k] = std::round(2 * origin[k]) / 2;
                    const Ray ray{origin, direction};
                    ASSERT_TRUE(oracle.accepts(ray, kernel->kernelIntersectGeometry(ray)))
                        << "from " << origin << " along " << direction;
                    const V3f end = origin + 2.0F * direction;
                    ASSERT_TRUE(oracle.accepts(origin, end, kernel->kernelVisibility(origin, end)))
                        << "between " << origin << " and " << end;
                }
            }
        }
    }
}

TEST(Rays, RaysThroughGridPointsHitTheGrid) {
    const Triangles triangles = grid();
    const auto kernel = kernelFor(triangles);
    for (int x = 1; x < 16; ++x) {
        for (int y = 1; y < 16; ++y) {
            for (const float z : {-2.0F, 3.0F}) {
                const V3f target(x / 2.0F, y / 2.0F, 0);
                const Ray ray{V3f(target.x, target.y, z), V3f(0, 0, z > 0 ? -1 : 1)};
                const auto hit = kernel->kernelIntersectGeometry(ray);
                ASSERT_TRUE(hit) << target;
                ASSERT_FLOAT_EQ(hit->distance, std::abs(z)) << target;
                ASSERT_FALSE(kernel->kernelVisibility(ray.origin, V3f(target.x, target.y, -z)));
            }
        }
    }
}

TEST(Rays, RaysInThePlaneOfATriangleGetADefinedAnswer) {
    std::mt19937 random(18);
    const Triangles triangles = joined({soup(300, 0.3, random), grid(), box(V3f(-3), V3f(9))});
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (const Triangle& triangle : triangles) {
        const V3d a(triangle.vertices[0]), b(triangle.vertices[1]), c(triangle.vertices[2]);
        const auto pointInPlane = [&] {
            const double s = uniform(random), t = uniform(random);
            return V3f(a + s * (b - a) + t * (c - a));
        };
        for (int i = 0; i < 5; ++i) {
            const V3f x = pointInPlane(), y = pointInPlane();
            for (const Ray& ray : {towards(x, y), towards(x, V3f(a)), towards(V3f(a), V3f(b))})
                ASSERT_TRUE(oracle.accepts(ray, kernel->kernelIntersectGeometry(ray)))
                    << "from " << ray.origin << " along " << ray.direction;
            ASSERT_TRUE(oracle.accepts(x, y, kernel->kernelVisibility(x, y)))
                << "between " << x << " and " << y;
        }
    }
}

/// Rays with one component that is not finite, in the origin or in the direction.
std::vector<Ray> nonFiniteRays() {
    std::vector<Ray> rays;
    for (const float bad : {NOT_A_NUMBER, INFINITE, -INFINITE}) {
        for (int axis = 0; axis < 3; ++axis) {
            const Ray good{V3f(0.1F, 0.2F, 0.3F), V3f(0.6F, 0, 0.8F)};
            rays.insert(rays.end(), {good, good});
            rays.end()[-2].origin[axis] = bad;
            rays.end()[-1].direction[axis] = bad;
        }
    }
    return rays;
}

TEST(Rays, NonFiniteRaysMiss) {
    const Triangles mesh = sphere(V3f(0), 1, 3, 0);
    const auto kernel = kernelFor(mesh);
    for (const Ray& ray : nonFiniteRays()) {
        const V3f& x = ray.origin;
        const V3f y = x + 2.0F * ray.direction;
        EXPECT_FALSE(kernel->kernelIntersectGeometry(ray)) << x << " along " << ray.direction;
        const bool isVisible = kernel->kernelVisibility(x, y);
        if (std::isnan((x + y).dot(V3f(1)))) {
            EXPECT_TRUE(isVisible) << "between " << x << " and " << y;
        }
    }
    EXPECT_FALSE(kernel->kernelIntersectGeometry({V3f(0), V3f(0)})) << "direction 0";
}

/// The mean time of asking h and V about one of the rays.
double secondsPerRay(const RTKernel& kernel, const std::vector<Ray>& rays) {
    const auto begin = std::chrono::steady_clock::now();
    for (const Ray& ray : rays) {
        kernel.kernelIntersectGeometry(ray);
        kernel.kernelVisibility(ray.origin, ray.origin + 2.0F * ray.direction);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    return seconds.count() / static_cast<double>(rays.size());
}

TEST(Rays, NoNonFiniteRayTakesLongerThanTenNormalRays) {
    // A ray that has lost its way meets thousands of triangles here, a normal one meets a few. All
    // kinds take turns, and a disturbance from outside would have to meet most rounds to matter.
    constexpr std::size_t ROUNDS = 9;
    const Triangles mesh = sphere(V3f(0), 1, 5, 0.1);
    const auto kernel = kernelFor(mesh);
    RandomPoints points(V3f(0), 0.5);
    std::vector<Ray> normal;
    for (int i = 0; i < 100; ++i) {
        const V3f origin = points.next();
        normal.push_back(towards(origin, points.next()));
    }
    const std::vector<Ray> nonFinite = nonFiniteRays();
    std::vector<std::array<double, ROUNDS>> ratios(nonFinite.size());
    for (std::size_t round = 0; round < ROUNDS; ++round) {
        const double secondsNormal = secondsPerRay(*kernel, normal);
        for (std::size_t kind = 0; kind < nonFinite.size(); ++kind)
            ratios[kind][round] =
                secondsPerRay(*kernel, std::vector<Ray>(10, nonFinite[kind])) / secondsNormal;
    }
    double worst = 0;
    for (auto& ofKind : ratios) {
        std::sort(ofKind.begin(), ofKind.end());
        worst = std::max(worst, ofKind[ROUNDS / 2]);
    }
    std::printf("%s: the slowest NaN or infinite ray takes %.2g times as long as a normal ray\n",
                KernelInfo::NAME, worst);
    EXPECT_LE(worst, 10);
}

}  // namespace
}  // namespace bwfirt::test
