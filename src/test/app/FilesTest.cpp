// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Files.h"

#include "scene/FileIO.h"
#include "test/Shapes.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

namespace fs = std::filesystem;

class Saving : public testing::Test {
  protected:
    Saving() { writeTriangles(folder / "box.ra2", test::box(V3f(-1), V3f(1))); }

    test::TemporaryFolder folder;
};

TEST_F(Saving, TheOldSceneFileIsKeptBesideTheNewOne) {
    const std::string old = "# mine\ntriangles box.ra2\nlights 0\n";
    const fs::path scene = folder.write("box.scene", old);
    const fs::path backup = saveLights(scene, {{2, 3, 50}});
    EXPECT_EQ(backup.filename(), "box.scene.bak");
    EXPECT_EQ(readTextFile(backup), old);
    EXPECT_EQ(readTextFile(scene), "# mine\ntriangles box.ra2\nlights 1 2 3 50\n");
}

TEST_F(Saving, NoBackupReplacesAnother) {
    const fs::path scene = folder.write("box.scene", "triangles box.ra2\n");
    saveLights(scene, {{2, 3, 50}});
    const fs::path second = saveLights(scene, {{2, 3, 60}});
    EXPECT_EQ(second.filename(), "box.scene.bak2");
    EXPECT_EQ(readTextFile(folder / "box.scene.bak"), "triangles box.ra2\n");
    EXPECT_EQ(readScene(second).lights[0].exitance, 50);
    EXPECT_EQ(readScene(scene).lights[0].exitance, 60);
}

TEST_F(Saving, ALinkStaysALink) {
    const fs::path scene = folder.write("box.scene", "triangles box.ra2\n");
    fs::create_symlink(scene, folder / "link.scene");
    saveLights(folder / "link.scene", {{2, 3, 50}});
    EXPECT_TRUE(fs::is_symlink(folder / "link.scene"));
    EXPECT_EQ(readScene(scene).lights.size(), 1u);
}

TEST_F(Saving, ASceneFileThatHasGoneIsAnError) {
    EXPECT_THROW(saveLights(folder / "none.scene", {{2, 3, 50}}), std::exception);
    EXPECT_FALSE(fs::exists(folder / "none.scene.bak"));
}

TEST_F(Saving, NewFilesHaveNamesThatAreFree) {
    const fs::path before = fs::current_path();
    fs::current_path(folder / "");
    EXPECT_EQ(newFile("some/where/box.scene", ".png"), "box-1.png");
    folder.write("box-1.png", "");
    EXPECT_EQ(newFile("some/where/box.scene", ".png"), "box-2.png");
    EXPECT_EQ(newFile("some/where/box.scene", ".camera"), "box-1.camera");
    fs::current_path(before);
}

}  // namespace
}  // namespace bwfirt
