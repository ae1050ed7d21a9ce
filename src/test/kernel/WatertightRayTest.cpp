// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/WatertightRay.h"

#include "test/Shapes.h"

#include <gtest/gtest.h>

#include <array>

namespace bwfirt::test {
namespace {

TEST(WatertightRay, FourTrianglesGetTheAnswerOfTheNearest) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::array<std::uint32_t, 4> indices = {3, 1, 2, 0};
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Triangles triangles = soup(4, 1.5, random);
        const std::size_t count = 1 + static_cast<std::size_t>(i) % 4;
        const Triangle4 four(triangles, std::span(indices.data(), count));
        V3d origin;
        for (int axis = 0; axis < 3; ++axis)
            origin[axis] = 2 * uniform(random);
        const auto& aim = triangles[static_cast<std::size_t>(i) % 3].vertices;
        const WatertightRay ray(origin, V3d(aim[0] + aim[1] + aim[2]) / 3 - origin);
        const double tMin = i % 2 * 0.5, tMax = 1.5;

        std::optional<WatertightRay::Meeting> nearest;
        for (std::size_t k = 0; k < count; ++k)
            if (const auto t = ray.intersect(triangles[indices[k]]))
                if (*t > tMin && *t < (nearest ? nearest->t : tMax))
                    nearest = {*t, indices[k]};
        const auto meeting = ray.intersect(four, tMin, tMax);
        ASSERT_EQ(meeting.has_value(), nearest.has_value());
        if (nearest) {
            ASSERT_EQ(meeting->t, nearest->t);
            ASSERT_EQ(meeting->triangle, nearest->triangle);
            ++hits;
        }
    }
    EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace bwfirt::test
