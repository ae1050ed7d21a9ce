// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

namespace bwfirt {

/// The colour map viridis, in nine steps of linear RGB, from dark blue at 0 to yellow at 1 and
/// beyond: it rises evenly in lightness, so that it survives grey printing and colour blindness.
V3d viridis(double value);

}  // namespace bwfirt
