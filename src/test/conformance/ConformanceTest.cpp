// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelInfo.h"
#include "kernel/KernelMemory.h"
#include "test/Oracle.h"
#include "test/Shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

// Every kernel has to pass these tests, on scenes that it is likely to get wrong.

namespace bwfirt::test {
namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/// The triangles have to outlive the kernel.
std::unique_ptr<RTKernel> kernelFor(Triangles&& triangles) = delete;
std::unique_ptr<RTKernel> kernelFor(const Triangles& triangles) {
    std::unique_ptr<RTKernel> kernel = createKernel();
    kernel->kernelInitialize(triangles);
    return kernel;
}

Ray towards(const V3f& origin, const V3f& target) {
    return {origin, V3f((V3d(target) - V3d(origin)).normalized())};
}

class RandomPoints {
  public:
    RandomPoints(const V3f& centre, double size) : centre_(centre), size_(size) {}

    V3f next() {
        const double x = uniform_(random_), y = uniform_(random_), z = uniform_(random_);
        return V3f(V3d(centre_) + size_ * V3d(x, y, z));
    }

  private:
    V3f centre_;
    double size_;
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Eight by eight squares from (0, 0, 0) to (8, 8, 0), two triangles each.
Triangles grid() {
    Triangles triangles;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
            triangles = joined({triangles, quad(V3f(x, y, 0), V3f(x + 1, y, 0),
                                                V3f(x + 1, y + 1, 0), V3f(x, y + 1, 0))});
    return triangles;
}

/// Asks rays and segments between random points of a cube, and tells all but the first wrong
/// answers by their number.
void expectRightAnswers(const Triangles& triangles, const V3f& centre, double size,
                        int queries = 1000) {
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    RandomPoints points(centre, size);
    int wrong = 0;
    for (int i = 0; i < queries; ++i) {
        const V3f x = points.next(), y = points.next();
        const Ray ray = towards(x, y);
        const auto hit = oracle.accepts(ray, kernel->kernelIntersectGeometry(ray));
        const auto visible = oracle.accepts(x, y, kernel->kernelVisibility(x, y));
        wrong += hit && visible ? 0 : 1;
        if (wrong == 1 && !(hit && visible)) {
            EXPECT_TRUE(hit) << "ray from " << x << " along " << ray.direction;
            EXPECT_TRUE(visible) << "between " << x << " and " << y;
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << queries << " pairs of queries";
}

TEST(Conformance, RandomTriangles) {
    std::mt19937 random(1);
    expectRightAnswers(soup(300, 0.3, random), V3f(0), 1.5);
    expectRightAnswers(soup(2000, 0.02, random), V3f(0), 1.2);
    expectRightAnswers(soup(50, 2, random), V3f(0), 3);
}

TEST(Conformance, ClosedMesh) {
    expectRightAnswers(sphere(V3f(1, 2, 3), 1, 4, 0.1), V3f(1, 2, 3), 2);
}

TEST(Conformance, NoOneOrTwoTriangles) {
    const Triangles nothing;
    const auto none = kernelFor(nothing);
    EXPECT_FALSE(none->kernelIntersectGeometry({V3f(0), V3f(1, 0, 0)}));
    EXPECT_TRUE(none->kernelVisibility(V3f(0), V3f(1)));
    std::mt19937 random(2);
    expectRightAnswers(soup(1, 1, random), V3f(0), 2);
    expectRightAnswers(soup(2, 1, random), V3f(0), 2);
}

TEST(Conformance, AllTrianglesIdentical) {
    expectRightAnswers(Triangles(1000, Triangle{{V3f(-1, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)}}),
                       V3f(0), 2, 300);
}

TEST(Conformance, DuplicateAndCoplanarTriangles) {
    expectRightAnswers(joined({grid(), grid(), box(V3f(-3, -3, 0), V3f(3, 3, 2))}), V3f(0), 9);
}

TEST(Conformance, TrianglesWithoutAreaAreNeverHit) {
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

TEST(Conformance, NonFiniteTrianglesAreNeverHitAndSpoilNothing) {
    std::mt19937 random(4);
    Triangles triangles = soup(300, 0.3, random);
    const std::array<float, 3> bad = {NOT_A_NUMBER, INFINITE, -INFINITE};
    for (std::size_t i = 0; i < triangles.size(); i += 7)
        triangles[i].vertices[i % 3][static_cast<int>(i % 2)] = bad[i / 7 % 3];
    expectRightAnswers(triangles, V3f(0), 1.5);
    expectRightAnswers(Triangles(9, Triangle{{V3f(NOT_A_NUMBER), V3f(1), V3f(0, 1, 0)}}), V3f(0), 2,
                       100);
}

TEST(Conformance, TinyTriangles) {
    std::mt19937 random(5);
    for (const double scale : {1e-6, 1e-12}) {
        Triangles triangles = soup(300, 0.3, random);
        for (Triangle& triangle : triangles)
            for (V3f& vertex : triangle.vertices)
                vertex = V3f(scale * V3d(vertex));
        expectRightAnswers(triangles, V3f(0), 1.5 * scale);
    }
}

TEST(Conformance, OneHugeAmongManySmallTriangles) {
    std::mt19937 random(6);
    const Triangles huge = {{{V3f(-1e6F, -2, -1e6F), V3f(1e6F, -2, -1e6F), V3f(0, -2, 1e6F)}}};
    expectRightAnswers(joined({soup(1000, 0.1, random), huge}), V3f(0), 1.5);
}

TEST(Conformance, ExtremeCoordinatesGetADefinedAnswer) {
    std::mt19937 random(7);
    for (const float scale : {1e17F, 3e38F, 1e-40F}) {
        Triangles triangles = soup(100, 0.3, random);
        for (Triangle& triangle : triangles)
            triangle.vertices[0] *= scale / 2;
        const auto kernel = kernelFor(triangles);
        RandomPoints points(V3f(0), 1.5);
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
}

TEST(Conformance, AxisParallelRaysWithEitherSignOfZero) {
    // All coordinates are small whole numbers: rays run through vertices, along edges and within
    // planes of the tree, and every product is exact.
    Triangles triangles =
        joined({box(V3f(-2), V3f(2)), box(V3f(-1), V3f(1)), box(V3f(0), V3f(1, 2, 1))});
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
                }
            }
        }
    }
}

TEST(Conformance, RaysThroughGridPointsHitTheGrid) {
    const Triangles triangles = grid();
    const auto kernel = kernelFor(triangles);
    for (int x = 1; x < 16; ++x) {
        for (int y = 1; y < 16; ++y) {
            for (const float z : {-2.0F, 3.0F}) {
                const V3f target(x / 2.0F, y / 2.0F, 0);
                const Ray ray{V3f(target.x, target.y, z), V3f(0, 0, z > 0 ? -1 : 1)};
                const auto hit = kernel->kernelIntersectGeometry(ray);
                ASSERT_TRUE(hit) << target;
                ASSERT_EQ(hit->distance, std::abs(z)) << target;
                ASSERT_FALSE(kernel->kernelVisibility(ray.origin, V3f(target.x, target.y, -z)));
            }
        }
    }
}

TEST(Conformance, NonFiniteRaysMiss) {
    const Triangles mesh = sphere(V3f(0), 1, 3, 0);
    const auto kernel = kernelFor(mesh);
    for (const float bad : {NOT_A_NUMBER, INFINITE, -INFINITE}) {
        for (int axis = 0; axis < 3; ++axis) {
            V3f point(0.1F, 0.2F, 0.3F), direction = V3f(0.6F, 0, 0.8F);
            point[axis] = bad;
            EXPECT_FALSE(kernel->kernelIntersectGeometry({point, direction}));
            direction[axis] = bad;
            EXPECT_FALSE(kernel->kernelIntersectGeometry({V3f(0), direction}));
            if (std::isnan(bad)) {
                EXPECT_TRUE(kernel->kernelVisibility(point, V3f(5)));
            }
        }
    }
    EXPECT_FALSE(kernel->kernelIntersectGeometry({V3f(0), V3f(0)})) << "direction 0";
}

/// Rays from inside a closed mesh, aimed at target(triangle, corner), and how many get out.
template <typename Target>
int escapes(const RTKernel& kernel, const Triangles& mesh, const V3f& centre,
            const Target& target) {
    RandomPoints origins(centre, 0.3);
    int count = 0;
    for (int repeat = 0; repeat < 4; ++repeat)
        for (const Triangle& triangle : mesh)
            for (std::size_t corner = 0; corner < 3; ++corner)
                if (!kernel.kernelIntersectGeometry(
                        towards(origins.next(), V3f(target(triangle, corner)))))
                    ++count;
    return count;
}

TEST(Conformance, NoRayLeavesAClosedMesh) {
    const V3f centre(11, -7, 3);
    const auto vertex = [](const Triangle& triangle, std::size_t corner) {
        return V3d(triangle.vertices[corner % 3]);
    };
    const auto edge = [&](const Triangle& triangle, std::size_t corner) {
        return (vertex(triangle, corner) + vertex(triangle, corner + 1)) / 2;
    };
    const auto interior = [&](const Triangle& triangle, std::size_t corner) {
        return (edge(triangle, corner) + vertex(triangle, corner + 2)) / 2;
    };
    for (const Triangles& mesh :
         {sphere(centre, 2, 3, 0.1), box(centre - V3f(2), centre + V3f(1))}) {
        const auto kernel = kernelFor(mesh);
        const int interiors = escapes(*kernel, mesh, centre, interior);
        const int edges = escapes(*kernel, mesh, centre, edge);
        const int vertices = escapes(*kernel, mesh, centre, vertex);
        std::printf(
            "%s: of %zu rays each, %d at interiors, %d at edges and %d at vertices missed\n",
            KernelInfo::NAME, 12 * mesh.size(), interiors, edges, vertices);
        EXPECT_EQ(interiors + edges + vertices, 0);
    }
}

TEST(Conformance, ManyRaysGetTheAnswersOfSingleRays) {
    std::mt19937 random(8);
    const Triangles triangles = soup(500, 0.3, random);
    const auto kernel = kernelFor(triangles);
    RandomPoints points(V3f(0), 1.5);
    for (const std::size_t count : {0, 1, 2, 7, 16, 64, 333}) {
        std::vector<Ray> rays;
        std::vector<RTKernel::Segment> segments;
        for (std::size_t i = 0; i < count; ++i) {
            const V3f x = points.next(), y = points.next();
            rays.push_back(towards(x, y));
            segments.push_back({x, y});
        }
        std::vector<std::optional<Hit>> hits(count);
        const auto visible = std::make_unique<bool[]>(count);
        kernel->kernelIntersectMany(rays, hits);
        kernel->kernelVisibleMany(segments, {visible.get(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const auto hit = kernel->kernelIntersectGeometry(rays[i]);
            ASSERT_EQ(hit.has_value(), hits[i].has_value());
            ASSERT_TRUE(!hit ||
                        (hit->distance == hits[i]->distance && hit->triangle == hits[i]->triangle));
            ASSERT_EQ(kernel->kernelVisibility(segments[i].x, segments[i].y), visible[i]);
        }
    }
}

TEST(Conformance, ManyThreadsGetTheAnswersOfOne) {
    std::mt19937 random(9);
    const Triangles triangles = soup(500, 0.3, random);
    const auto kernel = kernelFor(triangles);
    RandomPoints points(V3f(0), 1.5);
    std::vector<Ray> rays;
    std::vector<std::optional<Hit>> hits;
    for (int i = 0; i < 2000; ++i) {
        const V3f x = points.next();
        rays.push_back(towards(x, points.next()));
        hits.push_back(kernel->kernelIntersectGeometry(rays.back()));
    }
    int different = 0;
#pragma omp parallel for num_threads(8) reduction(+ : different)
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto hit = kernel->kernelIntersectGeometry(rays[i]);
        different += hit.has_value() == hits[i].has_value() &&
                             (!hit || (hit->distance == hits[i]->distance &&
                                       hit->triangle == hits[i]->triangle))
                         ? 0
                         : 1;
    }
    EXPECT_EQ(different, 0);
}

TEST(Conformance, AllMemoryIsGivenBack) {
    std::mt19937 random(10);
    const Triangles triangles = soup(1000, 0.3, random);
    ASSERT_EQ(KernelMemory::bytesNow(), 0u);
    kernelFor(triangles).reset();
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
}

TEST(Conformance, EveryOptionTakesItsDefault) {
    const auto kernel = createKernel();
    for (const KernelOption& option : kernel->kernelOptions()) {
        EXPECT_NO_THROW(kernel->kernelSetOption(option.name, option.value)) << option.name;
        EXPECT_FALSE(option.meaning.empty()) << option.name;
    }
}

}  // namespace
}  // namespace bwfirt::test
