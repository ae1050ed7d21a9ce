// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Completeness.h"

#include "scene/TextReader.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bwfirt {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
    throw std::runtime_error(path.string() + ": " + what);
}

// ---- PLY ----------------------------------------------------------------------------------------

const std::map<std::string, std::size_t> BYTES_OF = {
    {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
    {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
    {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};

struct Property {
    std::size_t countBytes;  ///< of the number of values that comes first; 0: no list
    std::size_t valueBytes;
};

struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
};

struct PlyHeader {
    std::string format;
    std::vector<Element> elements;
};

PlyHeader readPlyHeader(std::istream& file, const fs::path& path) {
    PlyHeader header;
    const auto bytesOf = [&](const std::string& type) {
        const auto found = BYTES_OF.find(type);
        if (found == BYTES_OF.end())
            fail(path, "unknown type '" + printable(type) + "' in its header");
        return found->second;
    };
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key, name, type;
        words >> key;
        if (key == "end_header")
            return header;
        if (key == "format") {
            words >> header.format;
        } else if (key == "element") {
            Element element{};
            if (!(words >> element.name >> element.count))
                fail(path,
                     "expected a name and a count in its header, not '" + printable(line) + "'");
            header.elements.push_back(element);
        } else if (key == "property" && !header.elements.empty()) {
            words >> type;
            Property property{};
            if (type == "list") {
                words >> type;
                property.countBytes = bytesOf(type);
                words >> type;
            }
            property.valueBytes = bytesOf(type);
            header.elements.back().properties.push_back(property);
        }
    }
    fail(path, "ends within its header");
}

/// Skips the values of a PLY file one after the other. Each call is false at the end of the file.
class PlyValues {
  public:
    PlyValues(std::istream& file, const std::string& format)
        : file_(file), isAscii_(format == "ascii"), isSwapped_(format == "binary_big_endian") {}

    bool skip(std::uint64_t values, std::size_t bytesEach) {
        if (isAscii_) {
            while (values > 0 && file_ >> word_)
                --values;
            return values == 0;
        }
        const auto bytes = static_cast<std::streamsize>(values * bytesEach);
        return file_.ignore(bytes) && file_.gcount() == bytes;
    }

    /// The number of values of a list.
    std::optional<std::uint64_t> count(std::size_t bytes) {
        if (isAscii_) {
            std::uint64_t value = 0;
            return file_ >> value ? std::optional(value) : std::nullopt;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i) {
            const auto byte = static_cast<std::uint64_t>(file_.get());
            value = isSwapped_ ? value << 8 | byte : value | byte << 8 * i;
        }
        if (!file_)
            return std::nullopt;
        return value;
    }

  private:
    std::istream& file_;
    bool isAscii_;
    bool isSwapped_;
    std::string word_;
};

bool skipElement(PlyValues& values, const Element& element) {
    for (const Property& property : element.properties) {
        std::optional<std::uint64_t> count = 1;
        if (property.countBytes > 0)
            count = values.count(property.countBytes);
        if (!count || *count > UINT32_MAX || !values.skip(*count, property.valueBytes))
            return false;
    }
    return true;
}

void requireCompletePly(std::istream& file, const fs::path& path) {
    const PlyHeader header = readPlyHeader(file, path);
    PlyValues values(file, header.format);
    for (const Element& element : header.elements)
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
            if (!skipElement(values, element))
                fail(path, "ends before " + printable(element.name) + " " + std::to_string(i + 1) +
                               " of " + std::to_string(element.count));
}

// ---- STL ----------------------------------------------------------------------------------------

constexpr std::uintmax_t STL_HEADER_BYTES = 84, STL_FACET_BYTES = 50;
constexpr std::uintmax_t TAIL_BYTES = 1000;

/// Of a text that begins with "solid". A binary file may begin so, too, and tells its size.
void requireCompleteStl(std::istream& file, const fs::path& path) {
    const std::uintmax_t size = fs::file_size(path);
    std::uint32_t facets = 0;
    file.seekg(STL_HEADER_BYTES - sizeof facets);
    file.read(reinterpret_cast<char*>(&facets), sizeof facets);
    if (file && size == STL_HEADER_BYTES + STL_FACET_BYTES * facets)
        return;
    file.clear();
    file.seekg(static_cast<std::streamoff>(size - std::min(size, TAIL_BYTES)));
    std::string tail(TAIL_BYTES, '\0');
    file.read(tail.data(), TAIL_BYTES);
    if (tail.find("endsolid") == std::string::npos && tail.find("ENDSOLID") == std::string::npos)
        fail(path, "ends without the line 'endsolid'");
}

}  // namespace

void requireComplete(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string first;
    std::getline(file, first);
    if (first == "ply" || first == "ply\r")
        requireCompletePly(file, path);
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".stl" && first.starts_with("solid"))
        requireCompleteStl(file, path);
}

}  // namespace bwfirt
