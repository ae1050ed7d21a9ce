// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Display.h"

#include "film/ColourMap.h"
#include "film/ImageFile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bwfirt {

namespace {

/// encodeSrgb() by a table, which is fine enough even where the curve is steepest: a step of the
/// table is a twentieth of a step of its values.
class SrgbTable {
  public:
    SrgbTable() {
        for (std::size_t i = 0; i < table_.size(); ++i)
            table_[i] = encodeSrgb(static_cast<double>(i) / LAST);
    }

    std::uint8_t operator()(float linear) const {
        return linear > 0 ? table_[static_cast<std::size_t>(std::min(linear, 1.F) * LAST + 0.5F)]
                          : 0;
    }

  private:
    static constexpr std::size_t SIZE = 1 << 16;
    static constexpr float LAST = SIZE - 1;
    std::array<std::uint8_t, SIZE> table_{};
};

bool isExposed(const std::optional<View>& view) {
    return !view || *view == View::EVEN_LIGHT;
}

}  // namespace

std::vector<std::uint8_t> displayed(const Picture& picture, Exposure exposure) {
    static const SrgbTable encode;
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * picture.pixels.size());
    const auto factor =
        static_cast<float>(isExposed(picture.view) ? std::exp2(exposure.stops) : 1.0);
    const double longest = longestTime(picture, exposure);
    for (const V3f& pixel : picture.pixels) {
        const V3f colour =
            picture.view == View::TIME ? V3f(viridis(pixel.x / longest)) : factor * pixel;
        for (const float component : {colour.x, colour.y, colour.z})
            pixels.push_back(encode(component));
    }
    return pixels;
}

double longestTime(const Picture& picture, Exposure exposure) {
    return picture.longestTime / std::exp2(exposure.stops);
}

std::vector<std::uint8_t> enlarged(const std::vector<std::uint8_t>& pixels, int width, int height,
                                   int newWidth, int newHeight) {
    std::vector<std::uint8_t> result;
    result.reserve(3 * static_cast<std::size_t>(newWidth) * static_cast<std::size_t>(newHeight));
    for (int y = 0; y < newHeight; ++y) {
        for (int x = 0; x < newWidth; ++x) {
            const int source = y * height / newHeight * width + x * width / newWidth;
            const auto pixel = pixels.begin() + 3 * static_cast<std::ptrdiff_t>(source);
            result.insert(result.end(), pixel, pixel + 3);
        }
    }
    return result;
}

}  // namespace bwfirt
