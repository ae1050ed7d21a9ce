// SPDX-License-Identifier: GPL-3.0-only
#include "test/conformance/Conformance.h"

namespace bwfirt::test {
namespace {

TEST(Threads, ManyThreadsGetTheAnswersOfOne) {
    std::mt19937 random(9);
    const Triangles triangles = soup(500, 0.3, random);
    const auto kernel = kernelFor(triangles);
    RandomPoints points(V3f(0), 1.5);
    struct Question {
        V3f x, y;
        std::optional<Hit> hit;
        bool isVisible;
    };
    std::vector<Question> questions;
    for (int i = 0; i < 5000; ++i) {
        const V3f x = points.next(), y = points.next();
        questions.push_back(
            {x, y, kernel->kernelIntersectGeometry(towards(x, y)), kernel->kernelVisibility(x, y)});
    }
    int different = 0;
#pragma omp parallel for num_threads(8) schedule(dynamic) reduction(+ : different)
    for (const auto& [x, y, hit, isVisible] : questions) {
        const bool isSame = areSame(kernel->kernelIntersectGeometry(towards(x, y)), hit) &&
                            kernel->kernelVisibility(x, y) == isVisible;
        different += isSame ? 0 : 1;
    }
    EXPECT_EQ(different, 0);
}

/// Every eleventh question has a number that is none.
void expectTheAnswersOfSingleRays(const Triangles& triangles) {
    const auto kernel = kernelFor(triangles);
    RandomPoints points(V3f(0), 1.5);
    for (const std::size_t count : {0, 1, 2, 7, 16, 64, 333}) {
        std::vector<Ray> rays;
        std::vector<RTKernel::Segment> segments;
        for (std::size_t i = 0; i < count; ++i) {
            const V3f x = points.next();
            const V3f y = i % 11 == 10 ? V3f(NOT_A_NUMBER) : points.next();
            rays.push_back(towards(x, y));
            segments.push_back({x, y});
        }
        std::vector<std::optional<Hit>> hits(count);
        const auto visible = std::make_unique<bool[]>(count);
        kernel->kernelIntersectMany(rays, hits);
        kernel->kernelVisibleMany(segments, {visible.get(), count});
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_TRUE(areSame(kernel->kernelIntersectGeometry(rays[i]), hits[i]));
            ASSERT_EQ(kernel->kernelVisibility(segments[i].x, segments[i].y), visible[i]);
        }
    }
}

TEST(Threads, ManyRaysGetTheAnswersOfSingleRays) {
    std::mt19937 random(8);
    expectTheAnswersOfSingleRays(soup(500, 0.3, random));
}

TEST(Threads, ManyRaysGetTheAnswersOfSingleRaysWhereTrianglesCoincide) {
    std::mt19937 random(8);
    const Triangles triangles = soup(300, 0.3, random);
    expectTheAnswersOfSingleRays(joined({triangles, triangles, triangles}));
}

}  // namespace
}  // namespace bwfirt::test
