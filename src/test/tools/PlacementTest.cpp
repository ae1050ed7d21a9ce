// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Placement.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

using Imath::Box3d;

TEST(Placement, TheFactorIsAPowerOfTwoThatBringsTheLargestCoordinateBelow100) {
    for (const double size : {1e-38, 1e-3, 0.99, 1.0, 50.0, 50.1, 99.9, 100.0, 100.1, 3e38}) {
        const Placement placement = placementFor(Box3d(V3d(-size), V3d(size / 2)), std::nullopt);
        int exponent = 0;
        EXPECT_EQ(std::frexp(placement.factor, &exponent), 0.5) << size;
        EXPECT_GT(placement.factor * size, 50) << size;
        EXPECT_LE(placement.factor * size, 100) << size;
        EXPECT_EQ(placement.origin, V3d(0)) << size;
    }
}

TEST(Placement, AModelFartherAwayThanItIsLargeIsMovedToTheOrigin) {
    const Placement near = placementFor(Box3d(V3d(0), V3d(2)), std::nullopt);
    EXPECT_EQ(near.origin, V3d(0));
    const Placement far = placementFor(Box3d(V3d(3, 0, 0), V3d(5, 2, 2)), std::nullopt);
    EXPECT_EQ(far.origin, V3d(4, 1, 1));
    EXPECT_EQ(far(V3d(5, 2, 2)), V3d(64));
}

TEST(Placement, AScaleOfTheUsersMovesNothing) {
    const Placement placement = placementFor(Box3d(V3d(1000), V3d(1001)), 3.0);
    EXPECT_EQ(placement(V3d(1000)), V3d(3000));
}

TEST(Placement, ASinglePointStaysFinite) {
    const Placement placement = placementFor(Box3d(V3d(7), V3d(7)), std::nullopt);
    EXPECT_EQ(placement(V3d(7)), V3d(0));
}

}  // namespace
}  // namespace bwfirt
