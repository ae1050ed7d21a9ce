// SPDX-License-Identifier: GPL-3.0-only
#include "scene/FileIO.h"
#include "scene/Scene.h"

#include <bit>
#include <limits>
#include <new>
#include <stdexcept>

namespace bwfirt {

static_assert(std::endian::native == std::endian::little, "triangle files are little endian");

std::vector<Triangle> readTriangles(const std::filesystem::path& path) {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(path.string() + ": " + what);
    };
    const std::uintmax_t bytes = inputFileSize(path);
    const std::uintmax_t count = bytes / sizeof(Triangle);
    if (bytes % sizeof(Triangle) != 0)
        fail("a triangle takes 36 bytes, and the file's " + std::to_string(bytes) +
             " bytes are not a multiple of that");
    if (count > std::numeric_limits<std::uint32_t>::max())
        fail(std::to_string(count) + " triangles are more than indices of 32 bits can tell apart");

    const std::uintmax_t available = availableMemory();
    const std::string tooLarge = std::to_string(count) + " triangles take " +
                                 std::to_string(bytes) + " bytes, but only " +
                                 std::to_string(available) + " bytes of memory are left";
    if (bytes > available)
        fail(tooLarge);
    try {
        std::vector<Triangle> triangles(count);
        readBytes(path, triangles.data(), bytes);
        return triangles;
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(path.string() + ": " + tooLarge);
    }
}

void writeTriangles(const std::filesystem::path& path, const std::vector<Triangle>& triangles) {
    writeFileAtomically(path, {reinterpret_cast<const char*>(triangles.data()),
                               triangles.size() * sizeof(Triangle)});
}

}  // namespace bwfirt
