// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Checksum.h"
#include "scene/FileIO.h"

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace bwfirt {

/// A binary file begins with a header, a struct without padding. Its first members are `magic` and
/// `version`, its last one is `headerChecksum`, of all that stands before it; MAGIC and VERSION are
/// what the first two have to be.
template <typename Header>
std::uint64_t checksumOfHeader(const Header& header) {
    return checksumOfBytes(&header, offsetof(Header, headerChecksum));
}

/// Reads the header of a file of this size.
/// @param kind what the file should be, "a ray stream" for instance
/// @throws std::runtime_error "<file>: <what is wrong>"
template <typename Header>
Header readHeader(const std::filesystem::path& path, std::uintmax_t bytes,
                  const std::string& kind) {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(path.string() + ": " + what);
    };
    Header header;
    if (bytes < sizeof header)
        fail("is too short to be " + kind);
    readBytes(path, &header, sizeof header);
    if (header.magic != Header::MAGIC)
        fail("is not " + kind);
    if (header.version != Header::VERSION)
        fail("is " + kind + " of version " + std::to_string(header.version) +
             ", and only version " + std::to_string(Header::VERSION) + " can be read");
    if (header.headerChecksum != checksumOfHeader(header))
        fail("is damaged: its header does not fit its checksum");
    return header;
}

}  // namespace bwfirt
