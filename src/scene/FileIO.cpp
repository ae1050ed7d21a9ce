// SPDX-License-Identifier: GPL-3.0-only
#include "scene/FileIO.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace bwfirt {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
    throw std::runtime_error(path.string() + ": " + what);
}

[[noreturn]] void failWithErrno(const fs::path& path, const std::string& what) {
    fail(path, what + ": " + std::generic_category().message(errno));
}

}  // namespace

std::uintmax_t inputFileSize(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
        fail(path, "no such file");
    if (error)
        fail(path, "cannot be read: " + error.message());
    if (status.type() == fs::file_type::directory)
        fail(path, "is a folder, not a file");
    if (status.type() != fs::file_type::regular)
        fail(path, "is not a regular file");
    if (access(path.c_str(), R_OK) != 0)
        failWithErrno(path, "cannot be read");
    const std::uintmax_t size = fs::file_size(path, error);
    if (error)
        fail(path, "cannot be read: " + error.message());
    if (size == 0)
        fail(path, "is empty");
    return size;
}

std::string readTextFile(const fs::path& path) {
    const std::uintmax_t size = inputFileSize(path);
    if (size > availableMemory())
        fail(path, "its " + std::to_string(size) + " bytes are more than the memory that is left");
    std::string content(size, '\0');
    readBytes(path, content.data(), size);
    return content;
}

void readBytes(const fs::path& path, void* bytes, std::uintmax_t size, std::uintmax_t offset) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size)))
        fail(path, "cannot be read to its end");
}

AtomicFile::AtomicFile(const fs::path& path) : target_(path) {
    if (fs::is_directory(path))
        fail(path, "cannot be written: is a folder");
    name_ = path.string() + ".XXXXXX";
    descriptor_ = mkstemp(name_.data());
    if (descriptor_ < 0)
        failWithErrno(path, "cannot be written");
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
    if (!name_.empty())
        unlink(name_.c_str());
}

void AtomicFile::write(std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor_, content.data(), content.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            failWithErrno(target_, "cannot be written");
        content.remove_prefix(static_cast<std::size_t>(written));
    }
}

void AtomicFile::overwriteBeginning(std::string_view content) {
    const off_t end = lseek(descriptor_, 0, SEEK_CUR);
    if (end < 0 || lseek(descriptor_, 0, SEEK_SET) < 0)
        failWithErrno(target_, "cannot be written");
    write(content);
    if (lseek(descriptor_, end, SEEK_SET) < 0)
        failWithErrno(target_, "cannot be written");
}

void AtomicFile::commit() {
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(descriptor_, 0666 & ~mask) != 0 || fsync(descriptor_) != 0)
        failWithErrno(target_, "cannot be written");
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 || rename(name_.c_str(), target_.c_str()) != 0)
        failWithErrno(target_, "cannot be written");
    name_.clear();
}

void requireWritable(const fs::path& path) {
    AtomicFile probe(path);
}

void writeFileAtomically(const fs::path& path, std::string_view content) {
    AtomicFile file(path);
    file.write(content);
    file.commit();
}

std::uintmax_t availableMemory() {
    std::uintmax_t bytes = std::numeric_limits<std::uintmax_t>::max();
    std::ifstream meminfo("/proc/meminfo");
    for (std::string key; meminfo >> key;) {
        std::uintmax_t kibibytes = 0;
        if (key == "MemAvailable:" && meminfo >> kibibytes)
            bytes = kibibytes * 1024;
        meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min<std::uintmax_t>(bytes, limit.rlim_cur);
    return bytes;
}

}  // namespace bwfirt
