// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Camera.h"

#include "scene/FileIO.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <random>

namespace bwfirt {
namespace {

const std::string CONFERENCE =
    "type pinhole\n"
    "position 8.16643 -56.2558 11.4971\n"
    "direction 0.915894 0.400479 -0.0274723\n"
    "up 0.0102422 0.0451014 0.99893\n"
    "depth 1.37374\n"
    "filmSizeY 1\n"
    "sensorResponse 1\n"
    "referenceAverageIntensity (0.857282 0.857282 0.857282)\n";

TEST(CameraFile, TheCameraOfThePaperIsRead) {
    const test::TemporaryFolder folder;
    const Camera camera = readCamera(folder.write("a.camera", CONFERENCE));
    EXPECT_EQ(camera.position, V3d(8.16643, -56.2558, 11.4971));
    EXPECT_EQ(camera.direction, V3d(0.915894, 0.400479, -0.0274723));
    EXPECT_EQ(camera.depth, 1.37374);
    EXPECT_EQ(camera.referenceAverageIntensity, V3d(0.857282));
}

TEST(CameraFile, ParenthesesMayStandAlone) {
    const test::TemporaryFolder folder;
    std::string text = CONFERENCE;
    text.replace(text.find("(0.857282 0.857282 0.857282)"), 28, "( 0.1 0.2 0.3 )  # comment");
    const Camera camera = readCamera(folder.write("a.camera", text));
    EXPECT_EQ(camera.referenceAverageIntensity, V3d(0.1, 0.2, 0.3));
}

TEST(CameraFile, AReferenceReplacesTheOldOneAndNothingElse) {
    const test::TemporaryFolder folder;
    const std::string line = referenceLine(V3d(0.1, 0.2, 0.3), "17 passes");
    EXPECT_EQ(line, "referenceAverageIntensity (0.1 0.2 0.3)  # 17 passes\n");
    const std::string start = "# by hand\n" + CONFERENCE.substr(0, CONFERENCE.find("reference"));
    const std::string old = "referenceAverageIntensity (1 1 1) # old\n";
    for (const auto& [before, after] :
         {std::pair{start, start + line},
          {start + old, start + line},
          {old + start, line + start},
          {start + "# the end", start + "# the end\n" + line},
          {start + "\"referenceAverageIntensity\" (1 1 1)", start + line}}) {
        const std::filesystem::path path = folder.write("a.camera", before);
        writeReference(path, line);
        EXPECT_EQ(readTextFile(path), after);
        EXPECT_EQ(readCamera(path).referenceAverageIntensity, V3d(0.1, 0.2, 0.3));
    }
}

TEST(CameraFile, AWrittenCameraIsTheSameToTheBitWhenReadAgain) {
    const test::TemporaryFolder folder;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-40, 40);
    const auto number = [&] { return std::ldexp(mantissa(random), exponent(random)); };
    const auto vector = [&] {
        const double x = mantissa(random), y = mantissa(random), z = mantissa(random);
        return std::ldexp(1, exponent(random)) * V3d(x, y, z);
    };
    for (int i = 0; i < 200; ++i) {
        Camera camera{vector(),           vector(),           vector(),    std::abs(number()),
                      std::abs(number()), std::abs(number()), std::nullopt};
        if (i % 2 == 0)
            camera.referenceAverageIntensity = vector();
        writeCamera(folder / "a.camera", camera);
        EXPECT_EQ(readCamera(folder / "a.camera"), camera);
    }
}

TEST(CameraFile, ACommentComesFirst) {
    const test::TemporaryFolder folder;
    const Camera camera;
    const std::string text = cameraText(camera, "from here\nand there");
    EXPECT_TRUE(text.starts_with("# from here\n# and there\ntype pinhole\n")) << text;
    EXPECT_EQ(readCamera(folder.write("a.camera", text)), camera);
}

TEST(CameraFile, ErrorsNameFileLineAndKey) {
    const test::TemporaryFolder folder;
    std::string text = CONFERENCE;
    text.replace(text.find("1.37374"), 7, "deep");
    const std::filesystem::path path = folder.write("bad.camera", text);
    try {
        readCamera(path);
        FAIL() << "the camera was read";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(),
                  path.string() +
                      ":5: depth: expected a number above 0 in the range of float32, not 'deep'");
    }
}

TEST(CameraRays, TheCentreOfTheImageLooksAlongTheDirection) {
    Camera camera;
    camera.position = V3d(1, 2, 3);
    camera.direction = V3d(2, -1, 0.5);
    const Ray ray = CameraRays(camera, 640, 480).through(320, 240);
    EXPECT_EQ(ray.origin, V3f(1, 2, 3));
    EXPECT_NEAR((V3d(ray.direction) - camera.direction.normalized()).length(), 0, 1e-7);
}

// Depth 2 and film height 3: the upper border is seen under the slope 1.5 / 2, the right one, at
// an aspect ratio of 2, under 3 / 2.
TEST(CameraRays, BordersOfTheFilmAreWhereDepthAndSizePutThem) {
    Camera camera;
    camera.direction = V3d(0, 0, -5);
    camera.up = V3d(0.3, 1, 0);  // not orthogonal to direction, and turned about it
    camera.up = V3d(0, 2, -1);
    camera.depth = 2;
    camera.filmSizeY = 3;
    const CameraRays rays(camera, 200, 100);
    const V3f top = rays.through(100, 0).direction, right = rays.through(200, 50).direction;
    EXPECT_NEAR(top.y / -top.z, 0.75, 1e-6);
    EXPECT_NEAR(top.x, 0, 1e-7);
    EXPECT_NEAR(right.x / -right.z, 1.5, 1e-6);
    EXPECT_NEAR(right.y, 0, 1e-7);
}

// right = normalize(direction x up)
TEST(CameraRays, RightIsDirectionCrossUp) {
    Camera camera;
    camera.direction = V3d(0, 1, 0);
    camera.up = V3d(0, 0, 1);
    EXPECT_GT(CameraRays(camera, 10, 10).through(10, 5).direction.x, 0);
}

}  // namespace
}  // namespace bwfirt
