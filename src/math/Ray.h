// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

namespace bwfirt {

/// The half-line { origin + t * direction : 0 < t < infinity }. The direction has unit length up to
/// rounding, so t is a distance in scene units.
struct Ray {
    V3f origin;
    V3f direction;
};

}  // namespace bwfirt
