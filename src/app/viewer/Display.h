// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/viewer/LiveRenderer.h"

#include <cstdint>
#include <vector>

namespace bwfirt {

/// How bright a picture is shown: a factor of 2^stops.
struct Exposure {
    double stops = 0;

    bool operator==(const Exposure&) const = default;
};

/// The picture in 8-bit sRGB, three bytes a pixel. View::TIME is shown in viridis from 0 to
/// longestTime(). Only light, real or even, and time are exposed.
std::vector<std::uint8_t> displayed(const Picture& picture, Exposure exposure);

/// Seconds of h that View::TIME shows in yellow.
double longestTime(const Picture& picture, Exposure exposure);

/// What displayed() gives, enlarged to another size by repeating pixels.
std::vector<std::uint8_t> enlarged(const std::vector<std::uint8_t>& pixels, int width, int height,
                                   int newWidth, int newHeight);

}  // namespace bwfirt
