// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "test/TemporaryFolder.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// What the fuzz programs have in common. Each is one source file that defines
/// LLVMFuzzerTestOneInput, which libFuzzer calls with one input after the other; doc/testing tells
/// how to run them and how to add one.
namespace bwfirt::fuzz {

/// Ends the program where a promise is broken, so that libFuzzer keeps the input as a finding.
inline void require(bool kept, std::string_view promise) {
    if (kept)
        return;
    std::cerr << "broken promise: " << promise << std::endl;
    std::abort();
}

/// True for values, without padding, that have the same bits: -0 is not 0, and a NaN is itself.
template <typename T>
bool sameBits(const T& a, const T& b) {
    return std::ranges::equal(std::as_bytes(std::span(&a, 1)), std::as_bytes(std::span(&b, 1)));
}

inline void requireOneLine(std::string_view message) {
    for (const unsigned char c : message)
        require(c >= ' ' && c != 0x7f, "a message is one line without control characters");
}

/// The folder of a fuzz program for its files, in TMPDIR. Removed at the end of the program.
inline const test::TemporaryFolder& folder() {
    static const test::TemporaryFolder TEMPORARY;
    return TEMPORARY;
}

/// What the reader makes of a file of these bytes; nothing where it refuses them as it may, by a
/// std::runtime_error of one line.
template <typename Reader>
auto readAsFile(const std::uint8_t* data, std::size_t size, Reader read)
    -> std::optional<decltype(read(std::filesystem::path()))> {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::filesystem::path path = folder().write("input", bytes);
    try {
        return read(path);
    } catch (const std::runtime_error& error) {
        requireOneLine(error.what());
        return std::nullopt;
    }
}

}  // namespace bwfirt::fuzz
