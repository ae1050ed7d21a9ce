// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Scene.h"

#include "scene/FileIO.h"
#include "scene/TextReader.h"
#include "test/Shapes.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

class SceneFile : public testing::Test {
  protected:
    SceneFile() { writeTriangles(folder / "box.ra2", test::box(V3f(-1), V3f(1))); }

    Scene read(const std::string& text) { return readScene(folder.write("box.scene", text)); }

    /// The error that reading the text gives, without the path of the scene file.
    std::string errorOf(const std::string& text) {
        try {
            read(text);
        } catch (const std::runtime_error& error) {
            const std::string what = error.what(), path = (folder / "box.scene").string();
            return what.starts_with(path) ? what.substr(path.size()) : what;
        }
        return "no error";
    }

    test::TemporaryFolder folder;
};

TEST_F(SceneFile, CommentsAndLineBreaksSeparateWords) {
    const Scene scene = read(
        "# a box\nlights 2 0 1 100.5 # the floor\n   4 4 +2e1\r\nreflectance 0.25\n"
        "triangles box.ra2");
    EXPECT_EQ(scene.triangles.size(), 12u);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].last, 1u);
    EXPECT_EQ(scene.lights[0].exitance, 100.5);
    EXPECT_EQ(scene.lights[1].first, 4u);
    EXPECT_EQ(scene.lights[1].exitance, 20);
    EXPECT_EQ(scene.reflectance, 0.25);
}

TEST_F(SceneFile, ReflectanceAndLightsAreOptional) {
    const Scene scene = read("triangles box.ra2\n");
    EXPECT_EQ(scene.reflectance, 0.7);
    EXPECT_TRUE(scene.lights.empty());
}

TEST_F(SceneFile, AWrittenSceneIsTheSameWhenReadAgain) {
    writeTriangles(folder / "my box #1.ra2", test::box(V3f(-1), V3f(1)));
    Scene scene;
    scene.trianglesPath = "my box #1.ra2";
    scene.lights = {{2, 3, 0.1}, {7, 7, 1.0 / 3}};
    scene.reflectance = 0.123456789012345678;
    writeScene(folder / "a.scene", scene);
    const Scene again = readScene(folder / "a.scene");
    EXPECT_EQ(again.trianglesPath, scene.trianglesPath);
    EXPECT_EQ(again.reflectance, scene.reflectance);
    ASSERT_EQ(again.lights.size(), 2u);
    EXPECT_EQ(again.lights[1].first, 7u);
    EXPECT_EQ(again.lights[1].exitance, 1.0 / 3);
}

TEST_F(SceneFile, AQuoteInsideAPathIsWrittenAsItIs) {
    writeTriangles(folder / "a\"b.ra2", test::box(V3f(-1), V3f(1)));
    writeScene(folder / "a.scene", read("triangles a\"b.ra2"));
    EXPECT_EQ(readScene(folder / "a.scene").trianglesPath, "a\"b.ra2");
}

TEST_F(SceneFile, AControlCharacterInAPathIsRefused) {
    for (const std::string path : {"a\x01.ra2", "\"a\tb.ra2\"", "a\x7f"})
        EXPECT_TRUE(errorOf("triangles " + path).starts_with(":1: triangles: expected")) << path;
    EXPECT_TRUE(errorOf(std::string("triangles box.ra2\0x", 19)).starts_with(":1: triangles: "));
}

// Every light would take the memory of all triangles, were they not found to overlap before.
TEST_F(SceneFile, ManyLightsOverAllTrianglesAreRefusedAtOnce) {
    std::mt19937 random(1);
    writeTriangles(folder / "box.ra2", test::soup(100000, 0.1, random));
    std::string text = "triangles box.ra2 lights 100000";
    for (int i = 0; i < 100000; ++i)
        text += "\n0 99999 1";
    EXPECT_EQ(errorOf(text), ":3: lights: triangle 0 belongs to two lights");
}

TEST_F(SceneFile, APathThatNoWordCanHoldIsNotWritten) {
    Scene scene;
    for (const char* path : {"", "\"a.ra2", "a\" b.ra2", "a\nb.ra2", "a\tb.ra2"}) {
        scene.trianglesPath = path;
        EXPECT_THROW(writeScene(folder / "a.scene", scene), std::runtime_error);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.scene"));
}

TEST_F(SceneFile, ErrorsNameLineKeyAndWhatWasExpected) {
    EXPECT_EQ(errorOf("triangles box.ra2\n\ncolour 3"),
              ":3: scene: expected one of the keys triangles, lights, reflectance, not 'colour'");
    EXPECT_EQ(errorOf("lights 0"),
              ":1: triangles: expected this key with the path of a triangle file");
    EXPECT_EQ(errorOf("triangles box.ra2 triangles box.ra2"), ":1: triangles: is given twice");
    EXPECT_EQ(errorOf("triangles box.ra2\nlights 1 0"),
              ":2: lights: expected the index of a light's last triangle, not the end of the file");
    EXPECT_EQ(errorOf("triangles box.ra2\nlights -1"),
              ":2: lights: expected a count that is not negative, not -1");
    EXPECT_EQ(errorOf("triangles box.ra2 reflectance 1"),
              ":1: reflectance: expected a number in [0, 1), not 1");
    EXPECT_EQ(errorOf("triangles box.ra2\nreflectance nan"),
              ":2: reflectance: expected a number in [0, 1), not 'nan'");
    EXPECT_EQ(errorOf("triangles \"box.ra2\n"), ":1: expected a closing '\"' on the same line");
}

TEST_F(SceneFile, LightsAreChecked) {
    const std::string triangles = "triangles box.ra2\n";
    EXPECT_EQ(errorOf(triangles + "lights 1 0 12 1"),
              ":2: lights: light 0 12: the last triangle of the scene is 11");
    EXPECT_EQ(errorOf(triangles + "lights 1 -1 2 1"),
              ":2: lights: light -1 2: a triangle index is negative");
    EXPECT_EQ(errorOf(triangles + "lights 1 3 2 1"),
              ":2: lights: light 3 2: the first triangle comes after the last");
    EXPECT_EQ(errorOf(triangles + "lights 1 0 1 -1"),
              ":2: lights: light 0 1: the radiant exitance is negative");
    EXPECT_EQ(errorOf(triangles + "lights 3\n0 1 1\n4 6 1\n1 2 1"),
              ":5: lights: triangle 1 belongs to two lights");
    EXPECT_NE(errorOf(triangles + "lights 2 0 1 0 2 3 0").find(":2: lights: expected a radiant"),
              std::string::npos);
    EXPECT_EQ(errorOf(triangles + "lights 2 0 1 0 2 3 1"), "no error");
}

TEST_F(SceneFile, LightsNeedOneTriangleWithArea) {
    const V3f p(1, 2, 3);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    writeTriangles(folder / "box.ra2",
                   test::Triangles{{{p, p, p}}, {{p, p, V3f(nan)}}, {{V3f(0), p, V3f(1, 0, 0)}}});
    EXPECT_EQ(errorOf("triangles box.ra2 lights 1 0 1 1"),
              ":1: lights: light 0 1: its triangles have no area");
    EXPECT_EQ(errorOf("triangles box.ra2 lights 1 0 2 1"), "no error");
}

TEST_F(SceneFile, HostileBytesGiveOneShortLine) {
    const std::string error = errorOf("\x01\x02\nab\xff" + std::string(1000, 'x'));
    EXPECT_LT(error.size(), 200u);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_EQ(error.find('\x01'), std::string::npos);
}

TEST(Numbers, RoundTripExactly) {
    for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 100.0})
        EXPECT_EQ(parseNumber(formatNumber(value)), value);
}

TEST(Numbers, OnlyWholeFiniteNumbersAreTaken) {
    for (const char* text : {"", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "+-1", "--1"})
        EXPECT_EQ(parseNumber(text), std::nullopt) << text;
}

TEST(SceneWarnings, TellOfNonFiniteTrianglesAndLargeCoordinates) {
    Scene scene;
    scene.triangles = test::box(V3f(-1), V3f(128));
    EXPECT_TRUE(sceneWarnings(scene).empty());
    scene.triangles[3].vertices[1].x = std::numeric_limits<float>::infinity();
    ASSERT_EQ(sceneWarnings(scene).size(), 1u);
    EXPECT_TRUE(sceneWarnings(scene)[0].starts_with("1 triangles have an infinite or NaN"));
    scene.triangles[4].vertices[0].y = -129;
    EXPECT_EQ(sceneWarnings(scene).size(), 2u);
}

/// The text of the scene file after these lights have replaced its own.
std::string replaced(const test::TemporaryFolder& folder, const std::string& text,
                     const std::vector<Light>& lights) {
    writeLights(folder.write("box.scene", text), lights);
    return readTextFile(folder / "box.scene");
}

TEST_F(SceneFile, ReplacedLightsLeaveTheRestOfTheFileAsItIs) {
    EXPECT_EQ(replaced(folder,
                       "# a box\ntriangles box.ra2 # its walls\nlights 2 0 1 5\n  4 4 6  # two\n"
                       "reflectance .5",
                       {{7, 8, 0.1}}),
              "# a box\ntriangles box.ra2 # its walls\nlights 1 7 8 0.1  # two\nreflectance .5");
    EXPECT_EQ(replaced(folder, "lights 1 0 0 5 triangles box.ra2", {}),
              "lights 0 triangles box.ra2");
    EXPECT_EQ(
        replaced(folder, "triangles lights reflectance .5\nlights 0\n", {{1, 2, 3}, {5, 5, 4}}),
        "triangles lights reflectance .5\nlights 2\n    1 2 3\n    5 5 4\n")
        << "a file named lights";
}

TEST_F(SceneFile, LightsAreAppendedWhereThereAreNone) {
    EXPECT_EQ(replaced(folder, "triangles box.ra2", {{7, 8, 1}}),
              "triangles box.ra2\nlights 1 7 8 1\n");
    EXPECT_EQ(replaced(folder, "triangles box.ra2\n", {{7, 8, 1}}),
              "triangles box.ra2\nlights 1 7 8 1\n");
}

}  // namespace
}  // namespace bwfirt
