// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "film/Film.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace bwfirt {

/// The file with the ending (".exr") appended, whatever dots the name holds.
std::filesystem::path withEnding(const std::filesystem::path& base, const char* ending);

/// Writes BASE.exr, the means in linear RGB as 32-bit float, and BASE.png, the same in sRGB,
/// clipped to [0, 1]. Values beyond float32 are stored as its largest.
/// @throws std::runtime_error "<path>: <what is wrong>"; the file is then as it was before
void writeImages(const std::filesystem::path& base, const Film& film);

/// The colour value of a display, IEC 61966-2-1 (sRGB), of a linear one, clipped to [0, 1].
std::uint8_t encodeSrgb(double linear);

/// Writes a PNG file of rows of 8-bit sRGB, three bytes a pixel.
/// @throws std::runtime_error "<path>: <what is wrong>"; the file is then as it was before
void writePng(const std::filesystem::path& path, int width, int height,
              std::span<const std::uint8_t> pixels);

}  // namespace bwfirt
