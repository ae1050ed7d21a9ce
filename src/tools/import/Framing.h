// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Camera.h"
#include "scene/Triangle.h"

#include <span>

namespace bwfirt {

/// Width by height of an image of the default size.
constexpr double DEFAULT_ASPECT = 640.0 / 480.0;

/// A camera that sees all triangles from outside, from the front, the side and above at once. They
/// touch two opposite edges of an image of the default size, but for a small margin.
/// @param up one of the six directions along an axis
Camera framingCamera(std::span<const Triangle> triangles, const V3d& up);

}  // namespace bwfirt
