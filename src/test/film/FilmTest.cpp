// SPDX-License-Identifier: GPL-3.0-only
#include "film/Film.h"

#include "film/ImageFile.h"
#include "scene/FileIO.h"
#include "test/TemporaryFolder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <limits>

namespace bwfirt {
namespace {

TEST(Film, MeanIsOverPasses) {
    Film film(2, 1);
    EXPECT_EQ(film.mean(0, 0), V3d(0));
    for (int pass = 0; pass < 40; ++pass) {
        film.add(0, 0, V3d(pass, 1, 0));
        film.add(1, 0, V3d(2));
        film.endPass(V3d(0));
    }
    EXPECT_EQ(film.mean(0, 0), V3d(19.5, 1, 0));
    EXPECT_EQ(film.mean(1, 0), V3d(2));
    EXPECT_EQ(film.averageIntensity(), V3d(10.75, 1.5, 1));
}

// Values whose sum depends on the order: shards of 16 passes from zero, then the shards in order.
TEST(Film, SumsShardsInOrder) {
    Film film(1, 1);
    double total = 0, shard = 0;
    for (int pass = 0; pass < 100; ++pass) {
        const double value = 1.0 / (1 + pass * pass) + (pass % 16 == 3 ? 1e17 : 0);
        film.add(0, 0, V3d(value));
        film.endPass(V3d(value));
        shard += value;
        if (pass % 16 == 15) {
            total += shard;
            shard = 0;
        }
        EXPECT_EQ(film.mean(0, 0).x, (total + shard) / (pass + 1));
    }
}

// Averages 1, 2, 3, 4: variance 5/3, and that of their mean a quarter of it.
TEST(Film, StandardErrorComesFromTheSpreadOfThePasses) {
    Film film(1, 1);
    film.endPass(V3d(1));
    EXPECT_TRUE(std::isnan(film.standardError().x));
    for (const double average : {2, 3, 4})
        film.endPass(V3d(average));
    EXPECT_DOUBLE_EQ(film.standardError().x, std::sqrt(5.0 / 3 / 4));
}

TEST(Film, AnImageBeyondAllMemoryIsRefused) {
    EXPECT_THROW(Film(1 << 30, 1 << 20), std::runtime_error);
}

Film gradient() {
    Film film(3, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            film.add(x, y, V3d(x, y, 0.25));
    film.endPass(V3d(0));
    return film;
}

TEST(ImageFile, ExrHoldsLinearFloatsWithRowZeroOnTop) {
    const test::TemporaryFolder folder;
    writeImages(folder / "image.v1", gradient());
    Imf::InputFile file((folder / "image.v1.exr").c_str());
    ASSERT_EQ(file.header().dataWindow().max, Imath::V2i(2, 1));
    std::array<float, 6> red{}, green{}, blue{};
    Imf::FrameBuffer frame;
    for (auto& [name, data] : {std::pair("R", &red), {"G", &green}, {"B", &blue}}) {
        ASSERT_EQ(file.header().channels()[name].type, Imf::FLOAT);
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(data->data()),
                                      sizeof(float), 3 * sizeof(float)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(0, 1);
    EXPECT_EQ(red, (std::array<float, 6>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(green, (std::array<float, 6>{0, 0, 0, 1, 1, 1}));
    EXPECT_EQ(blue[5], 0.25F);
}

// 0.25 in sRGB is 1.055 * 0.25^(1/2.4) - 0.055 = 0.5371, and 137 of 255; 2 is clipped.
TEST(ImageFile, PngIsSrgb) {
    const test::TemporaryFolder folder;
    writeImages(folder / "image", gradient());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&image, (folder / "image.png").c_str()));
    image.format = PNG_FORMAT_RGB;
    ASSERT_EQ(image.width, 3u);
    ASSERT_EQ(image.height, 2u);
    std::array<png_byte, 18> pixels{};
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    EXPECT_EQ(pixels, (std::array<png_byte, 18>{0, 0, 137, 255, 0, 137, 255, 0, 137,  //
                                                0, 255, 137, 255, 255, 137, 255, 255, 137}));
}

TEST(ImageFile, InfiniteSumsAreStoredAsLargestFloat) {
    Film film(1, 1);
    film.add(0, 0, V3d(1e300));
    film.endPass(V3d(0));
    const test::TemporaryFolder folder;
    writeImages(folder / "image", film);
    Imf::InputFile file((folder / "image.exr").c_str());
    float red = 0;
    Imf::FrameBuffer frame;
    frame.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&red), 4, 4));
    file.setFrameBuffer(frame);
    file.readPixels(0);
    EXPECT_EQ(red, std::numeric_limits<float>::max());
}

TEST(FileIO, AtomicWritesReplaceTheWholeFileAndLeaveNothingBeside) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder.write("a.txt", "a long old content");
    writeFileAtomically(path, "new");
    EXPECT_EQ(readTextFile(path), "new");
    requireWritable(path);
    EXPECT_EQ(readTextFile(path), "new");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
    EXPECT_THROW(requireWritable(folder / "missing" / "a.txt"), std::runtime_error);
}

}  // namespace
}  // namespace bwfirt
