// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"

#include <gtest/gtest.h>

#include <array>

namespace bwfirt {
namespace {

/// Answers every ray with a hit at a fixed distance; remembers the ray.
class Wall : public RTKernel {
  public:
    explicit Wall(float distance) : distance_(distance) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        last = ray;
        if (!(ray.direction.x > 0))
            return std::nullopt;
        return Hit{distance_, 7};
    }
    mutable Ray last;

  private:
    float distance_;
};

TEST(RTKernel, VisibilityIsAFrontEndToRayShooting) {
    const V3f x(1, 2, 3), y(5, 2, 3);
    EXPECT_FALSE(Wall(3.999F).kernelVisibility(x, y));
    EXPECT_TRUE(Wall(4).kernelVisibility(x, y));
    EXPECT_TRUE(Wall(5).kernelVisibility(x, y));
    EXPECT_TRUE(Wall(1).kernelVisibility(y, x)) << "the way back is free";
    const Wall wall(1);
    wall.kernelVisibility(x, y);
    EXPECT_EQ(wall.last.origin, x);
    EXPECT_EQ(wall.last.direction, V3f(1, 0, 0));
}

TEST(RTKernel, ManyAnswersRayByRay) {
    const Wall wall(2);
    const std::array<Ray, 3> rays = {
        Ray{V3f(0), V3f(1, 0, 0)}, {V3f(0), V3f(-1, 0, 0)}, {V3f(0), V3f(1, 0, 0)}};
    std::array<std::optional<Hit>, 3> hits;
    wall.kernelIntersectMany(rays, hits);
    EXPECT_TRUE(hits[0] && !hits[1] && hits[2]);

    const std::array<RTKernel::Segment, 2> segments = {RTKernel::Segment{V3f(0), V3f(1, 0, 0)},
                                                       {V3f(0), V3f(3, 0, 0)}};
    std::array<bool, 2> visible{};
    wall.kernelVisibleMany(segments, visible);
    EXPECT_TRUE(visible[0]);
    EXPECT_FALSE(visible[1]);
}

TEST(RTKernel, HasNoOptionsOfItsOwn) {
    EXPECT_TRUE(Wall(1).kernelOptions().empty());
    EXPECT_THROW(Wall(1).kernelSetOption("leaf-size", "4"), std::invalid_argument);
}

}  // namespace
}  // namespace bwfirt
