// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <Imath/ImathVec.h>

#include <cmath>

namespace bwfirt {

/// Points, directions and colours. Files, rays and kernels' answers are single precision (V3f); the
/// light transport computes in double precision (V3d).
using Imath::V3d;
using Imath::V3f;

/// In templates Number is double, or several doubles with which a processor computes at once
/// (kernel/Simd4.h): each of them then gets the very bits that it would get alone.
using Imath::Vec3;

/// True where no component is infinite or NaN.
template <typename T>
bool isFinite(const Imath::Vec3<T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace bwfirt
