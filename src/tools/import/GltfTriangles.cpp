// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/GltfTriangles.h"

#include "scene/FileIO.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <string_view>

namespace bwfirt {

namespace {

using Json = nlohmann::json;

/// The first chunk of a GLB file is its JSON; a glTF file is nothing else.
std::string_view jsonPart(std::string_view content) {
    constexpr std::size_t LENGTH_AT = 12, JSON_AT = 20;
    if (!content.starts_with("glTF") || content.size() < JSON_AT)
        return content;
    std::uint32_t length = 0;
    std::memcpy(&length, content.data() + LENGTH_AT, sizeof length);
    return content.substr(JSON_AT, length);
}

std::uint64_t triangles(const Json& primitive, const Json& accessors) {
    enum Mode { TRIANGLES = 4, TRIANGLE_STRIP = 5, TRIANGLE_FAN = 6 };
    const std::size_t accessor = primitive.contains("indices")
                                     ? primitive.at("indices").get<std::size_t>()
                                     : primitive.at("attributes").at("POSITION").get<std::size_t>();
    const auto corners = accessors.at(accessor).at("count").get<std::uint64_t>();
    switch (primitive.value("mode", static_cast<int>(TRIANGLES))) {
        case TRIANGLES:
            return corners / 3;
        case TRIANGLE_STRIP:
        case TRIANGLE_FAN:
            return corners < 3 ? 0 : corners - 2;
        default:
            return 0;
    }
}

}  // namespace

std::uint64_t announcedGltfTriangles(const std::filesystem::path& path) {
    const std::string content = readTextFile(path);
    std::uint64_t count = 0;
    try {
        const Json file = Json::parse(jsonPart(content));
        for (const Json& mesh : file.at("meshes"))
            for (const Json& primitive : mesh.at("primitives"))
                count += triangles(primitive, file.at("accessors"));
    } catch (const Json::exception&) {
        return 0;  // what is wrong with the file is assimp's to say
    }
    return count;
}

}  // namespace bwfirt
