// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

#include <gtest/gtest.h>

namespace bwfirt::test {

/// Judges a kernel's answers by asking every triangle in double precision. It does not ask for one
/// right answer, which rounding in single precision would make too much of: near an edge, or where
/// a ray grazes a triangle, it lets both answers pass. How near is what a calculation in single
/// precision with the coordinates at hand may be wrong by.
class Oracle {
  public:
    explicit Oracle(std::span<const Triangle> triangles) : triangles_(triangles) {}

    /// A failure, which tells why, where this cannot be the answer of h.
    testing::AssertionResult accepts(const Ray& ray, const std::optional<Hit>& hit) const;

    /// A failure, which tells why, where this cannot be the answer of V.
    testing::AssertionResult accepts(const V3f& x, const V3f& y, bool isVisible) const;

  private:
    std::span<const Triangle> triangles_;
};

}  // namespace bwfirt::test
