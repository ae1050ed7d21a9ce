// SPDX-License-Identifier: GPL-3.0-only
#include "film/ImageFile.h"

#include "scene/FileIO.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bwfirt {

namespace {

std::string encodeExr(const Film& film) {
    std::vector<V3f> pixels;
    const auto toFloat = [](double value) {
        constexpr double LARGEST = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(value, -LARGEST, LARGEST));
    };
    for (int y = 0; y < film.height(); ++y) {
        for (int x = 0; x < film.width(); ++x) {
            const V3d mean = film.mean(x, y);
            pixels.emplace_back(toFloat(mean.x), toFloat(mean.y), toFloat(mean.z));
        }
    }

    Imf::Header header(film.width(), film.height());
    Imf::FrameBuffer frame;
    const std::size_t rowStride = sizeof(V3f) * static_cast<std::size_t>(film.width());
    for (const auto& [name, component] :
         {std::pair("R", &V3f::x), {"G", &V3f::y}, {"B", &V3f::z}}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&(pixels[0].*component)),
                                      sizeof(V3f), rowStride));
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(film.height());
    }
    return stream.str();
}

std::string encodePng(int width, int height, std::span<const std::uint8_t> pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t bytes = 0;
    std::string content;
    if (png_image_write_get_memory_size(image, bytes, 0, pixels.data(), 0, nullptr) == 0)
        throw std::runtime_error(std::string("PNG: ") + image.message);
    content.resize(bytes);
    if (png_image_write_to_memory(&image, content.data(), &bytes, 0, pixels.data(), 0, nullptr) ==
        0)
        throw std::runtime_error(std::string("PNG: ") + image.message);
    content.resize(bytes);
    return content;
}

std::string encodePng(const Film& film) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < film.height(); ++y) {
        for (int x = 0; x < film.width(); ++x) {
            const V3d mean = film.mean(x, y);
            for (const double value : {mean.x, mean.y, mean.z})
                pixels.push_back(encodeSrgb(value));
        }
    }
    return encodePng(film.width(), film.height(), pixels);
}

}  // namespace

std::filesystem::path withEnding(const std::filesystem::path& base, const char* ending) {
    return base.string() + ending;
}

std::uint8_t encodeSrgb(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    const double encoded =
        value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

void writePng(const std::filesystem::path& path, int width, int height,
              std::span<const std::uint8_t> pixels) {
    writeFileAtomically(path, encodePng(width, height, pixels));
}

void writeImages(const std::filesystem::path& base, const Film& film) {
    const std::string exr = encodeExr(film);
    const std::string png = encodePng(film);
    writeFileAtomically(withEnding(base, ".exr"), exr);
    writeFileAtomically(withEnding(base, ".png"), png);
}

}  // namespace bwfirt
