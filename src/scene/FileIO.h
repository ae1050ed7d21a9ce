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

/// Reads `size` bytes of a file from the byte `offset` on.
void readBytes(const std::filesystem::path& path, void* bytes, std::uintmax_t size,
               std::uintmax_t offset = 0);

/// Replaces a file as a whole: what is written goes to a neighbour, which is renamed in the end, so
/// that a reader, or a crash, meets the old content or the new one and never a part. A file that is
/// not committed leaves nothing behind.
class AtomicFile {
  public:
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Appends.
    void write(std::string_view content);

    /// Replaces the beginning of what was written.
    void overwriteBeginning(std::string_view content);

    void commit();

  private:
    std::filesystem::path target_;
    std::string name_;
    int descriptor_ = -1;
};

/// Fails where an AtomicFile could not be made: for a check before long work.
void requireWritable(const std::filesystem::path& path);

void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Bytes of memory that the process may still use without swapping.
std::uintmax_t availableMemory();

}  // namespace bwfirt
