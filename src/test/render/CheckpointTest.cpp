// SPDX-License-Identifier: GPL-3.0-only
#include "render/Checkpoint.h"

#include "scene/FileIO.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <functional>

namespace bwfirt {
namespace {

const RunIdentity IDENTITY = {1, 2, 3, 3, 2, "kernel", "leaf-size=4\n", ""};

/// A pass whose sums depend on the order in which passes are added.
void addPass(Film& film) {
    const double value = 1.0 / (1 + film.passes() * film.passes()) + film.passes() % 5 * 1e15;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            film.add(x, y, V3d(value * (x + 1), value, y));
    film.endPass(V3d(value));
}

Film filmOf(int passes) {
    Film film(IDENTITY.width, IDENTITY.height);
    for (int i = 0; i < passes; ++i)
        addPass(film);
    return film;
}

void expectSame(const Film& a, const Film& b) {
    ASSERT_EQ(a.passes(), b.passes());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            EXPECT_EQ(a.mean(x, y), b.mean(x, y));
    EXPECT_EQ(a.averageIntensity(), b.averageIntensity());
    EXPECT_EQ(a.standardError(), b.standardError());
}

TEST(Checkpoint, LetsAFilmGoOnAsIfItHadNeverEnded) {
    const test::TemporaryFolder folder;
    const Checkpoint checkpoint(folder / "a.checkpoint", IDENTITY);
    for (const int before : {2, 15, 16, 17, 32, 40}) {
        checkpoint.save(filmOf(before), {10, 20}, 1.5);
        Film film(IDENTITY.width, IDENTITY.height);
        RayCounts rays;
        double seconds = 0;
        ASSERT_TRUE(checkpoint.load(film, rays, seconds));
        EXPECT_EQ(rays.intersect, 10u);
        EXPECT_EQ(rays.visibility, 20u);
        EXPECT_EQ(seconds, 1.5);
        while (film.passes() < 50)
            addPass(film);
        expectSame(film, filmOf(50));
    }
}

TEST(Checkpoint, ThatIsNotThereLeavesAllAsItIs) {
    const test::TemporaryFolder folder;
    Film film = filmOf(3);
    RayCounts rays{1, 2};
    double seconds = 3;
    EXPECT_FALSE(Checkpoint(folder / "none", IDENTITY).load(film, rays, seconds));
    expectSame(film, filmOf(3));
    EXPECT_EQ(rays.visibility, 2u);
}

/// What loading says; empty where it succeeds.
std::string refusal(const std::filesystem::path& path, const RunIdentity& identity) {
    Film film(identity.width, identity.height);
    RayCounts rays;
    double seconds = 0;
    try {
        Checkpoint(path, identity).load(film, rays, seconds);
        return "";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(film.passes(), 0);
        return error.what();
    }
}

TEST(Checkpoint, OfAnotherRunIsRefused) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "a.checkpoint";
    Checkpoint(path, IDENTITY).save(filmOf(3), {}, 0);
    EXPECT_EQ(refusal(path, IDENTITY), "");
    const std::vector<std::pair<std::string, std::function<void(RunIdentity&)>>> changes = {
        {"scene", [](RunIdentity& run) { run.scene ^= 1; }},
        {"camera", [](RunIdentity& run) { run.camera ^= 1; }},
        {"seed", [](RunIdentity& run) { run.seed = 4; }},
        {"size of the image", [](RunIdentity& run) { std::swap(run.width, run.height); }},
        {"kernel", [](RunIdentity& run) { run.kernel = "kernel2"; }},
        {"setting of the kernel's options", [](RunIdentity& run) { run.kernelOptions = ""; }},
        {"view", [](RunIdentity& run) { run.view = "normals"; }},
    };
    for (const auto& [what, change] : changes) {
        RunIdentity identity = IDENTITY;
        change(identity);
        EXPECT_NE(refusal(path, identity).find("its " + what + " is not the same"),
                  std::string::npos)
            << what << ": " << refusal(path, identity);
    }
}

TEST(Checkpoint, IsRefusedWhenAnyByteIsDamagedOrMissing) {
    const test::TemporaryFolder folder;
    Checkpoint(folder / "a.checkpoint", IDENTITY).save(filmOf(3), {}, 0);
    const std::string content = readTextFile(folder / "a.checkpoint");
    for (std::size_t i = 0; i < content.size(); ++i) {
        std::string damaged = content;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        EXPECT_NE(refusal(folder.write("damaged", damaged), IDENTITY), "") << "byte " << i;
        EXPECT_NE(refusal(folder.write("short", content.substr(0, i)), IDENTITY), "") << i;
    }
    EXPECT_NE(refusal(folder.write("long", content + "x"), IDENTITY), "");
}

TEST(Checkpoint, TellsScenesAndCamerasApart) {
    Scene scene;
    scene.triangles = {{{V3f(0), V3f(1, 0, 0), V3f(0, 1, 0)}}};
    scene.lights = {{0, 0, 1}};
    const std::uint64_t before = checksumOf(scene);
    Scene brighter = scene, greyer = scene, moved = scene;
    brighter.lights[0].exitance = 2;
    greyer.reflectance = 0.5;
    moved.triangles[0].vertices[2].z = 1e-30F;
    for (const Scene& other : {brighter, greyer, moved})
        EXPECT_NE(checksumOf(other), before);

    Camera camera, referenced, turned;
    referenced.referenceAverageIntensity = V3d(1);
    turned.direction.x = 1e-300;
    EXPECT_EQ(checksumOf(referenced), checksumOf(camera)) << "the reference changes no image";
    EXPECT_NE(checksumOf(turned), checksumOf(camera));
}

}  // namespace
}  // namespace bwfirt
