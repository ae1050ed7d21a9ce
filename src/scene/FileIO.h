// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace bwfirt {

// All functions throw std::runtime_error with a message "<path>: <what is wrong>".

/// The size in bytes of a readable regular file. Anything else (missing, a folder, a FIFO, not
/// permitted) and an empty file are errors, found without opening a FIFO.
std::uintmax_t inputFileSize(const std::filesystem::path& path);

/// The whole content of a file of text.
std::string readTextFile(const std::filesystem::path& path);

/// Fails where `writeFileAtomically(path, …)` could not create its file: for a check before long
/// work. Leaves nothing behind.
void requireWritable(const std::filesystem::path& path);

/// Replaces the file as a whole: writes a neighbour and renames it, so that a reader, or a crash,
/// meets the old content or the new one and never a part.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Bytes of memory that the process may still use without swapping.
std::uintmax_t availableMemory();

}  // namespace bwfirt
