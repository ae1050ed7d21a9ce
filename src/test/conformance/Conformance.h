// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "test/Oracle.h"
#include "test/Shapes.h"

#include <gtest/gtest.h>

#include <limits>

// Every kernel has to pass the tests of this folder, which ask what kernels are likely to get
// wrong. They are the same for all kernels, and linked with one of them at a time.

namespace bwfirt::test {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/// The kernel, ready for queries. The triangles have to outlive it. Every fourth question that it
/// is asked alone it is also asked in flight, and the test fails where the answers differ.
std::unique_ptr<RTKernel> kernelFor(const Triangles& triangles);
std::unique_ptr<RTKernel> kernelFor(Triangles&& triangles) = delete;

bool areSame(const std::optional<Hit>& one, const std::optional<Hit>& other);

/// The ray from the origin through the target.
Ray towards(const V3f& origin, const V3f& target);

/// Points in a cube, from its centre to `size` beyond it in each direction.
class RandomPoints {
  public:
    RandomPoints(const V3f& centre, double size) : centre_(centre), size_(size) {}

    V3f next();

  private:
    V3f centre_;
    double size_;
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// A point inside a triangle, not close to its edges.
V3d pointInside(const Triangle& triangle, std::mt19937& random);

/// The point moved by NORMAL_OFFSET along the triangle's normal, or against it where `side` is -1.
V3f movedOff(const Triangle& triangle, const V3d& point, double side);

/// Eight by eight squares from (0, 0, 0) to (8, 8, 0), two triangles each.
Triangles grid();

/// Asks rays and segments between random points of a cube, and tells the first wrong answers and
/// their number.
void expectRightAnswers(const Triangles& triangles, const V3f& centre, double size,
                        int queries = 1000);

}  // namespace bwfirt::test
