// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Display.h"

#include "film/ColourMap.h"
#include "film/ImageFile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bwfirt {
namespace {

using Bytes = std::vector<std::uint8_t>;

Picture pictureOf(const std::vector<V3f>& pixels, std::optional<View> view = {}) {
    Picture picture;
    picture.width = static_cast<int>(pixels.size());
    picture.height = 1;
    picture.pixels = pixels;
    picture.view = view;
    return picture;
}

TEST(Display, ShowsTheValuesOfTheImageFile) {
    for (int i = -100; i < 3000; ++i) {
        const float value = static_cast<float>(i) / 2000;
        const Bytes shown = displayed(pictureOf({V3f(value)}), {});
        EXPECT_NEAR(shown[0], encodeSrgb(value), 1) << value;
    }
    EXPECT_EQ(displayed(pictureOf({V3f(0, 1, 1e30F)}), {}), (Bytes{0, 255, 255}));
    EXPECT_EQ(displayed(pictureOf({V3f(std::nanf(""))}), {}), (Bytes{0, 0, 0}));
}

TEST(Display, AStopOfExposureDoublesLightButNoFalseColour) {
    EXPECT_EQ(displayed(pictureOf({V3f(0.2F)}), {1}), displayed(pictureOf({V3f(0.4F)}), {}));
    EXPECT_EQ(displayed(pictureOf({V3f(0.4F)}), {-1}), displayed(pictureOf({V3f(0.2F)}), {}));
    const Picture normals = pictureOf({V3f(0.2F)}, View::NORMALS);
    EXPECT_EQ(displayed(normals, {1}), displayed(normals, {}));
}

TEST(Display, ShowsTimesInColoursUpToTheLongest) {
    Picture times = pictureOf({V3f(0), V3f(1e-6F), V3f(9)}, View::TIME);
    times.longestTime = 2e-6;
    const Bytes shown = displayed(times, {});
    for (int channel = 0; channel < 3; ++channel) {
        const auto value = [&](double time) { return encodeSrgb(viridis(time)[channel]); };
        const auto at = [&](int pixel) {
            return shown[static_cast<std::size_t>(3 * pixel + channel)];
        };
        EXPECT_NEAR(at(0), value(0), 1);
        EXPECT_NEAR(at(1), value(0.5), 1);
        EXPECT_NEAR(at(2), value(1), 1);
    }
    EXPECT_EQ(longestTime(times, {1}), 1e-6) << "more exposure shows shorter times";
}

TEST(Display, EnlargesByRepeatingPixels) {
    const Bytes pixels = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(enlarged(pixels, 2, 1, 4, 2),
              (Bytes{1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6, 1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6}));
    EXPECT_EQ(enlarged(pixels, 2, 1, 2, 1), pixels);
}

}  // namespace
}  // namespace bwfirt
