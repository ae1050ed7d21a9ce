// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "tools/import/Conversion.h"

namespace bwfirt {

/// What the user is told of an import, line by line: what came out, what was left out, and how a
/// scene without lights gets one.
std::string summary(const Model& model, const Conversion& conversion);

}  // namespace bwfirt
