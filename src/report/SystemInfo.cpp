// SPDX-License-Identifier: GPL-3.0-only
#include "report/SystemInfo.h"

#include <omp.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace bwfirt {

namespace {

/// The value behind the separator in the first line of the file that begins with the key.
std::string valueOf(const char* file, const std::string& key, char separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t position = line.find(separator);
        if (!line.starts_with(key) || position == std::string::npos)
            continue;
        const std::size_t begin = line.find_first_not_of(" \t\"", position + 1);
        const std::size_t end = line.find_last_not_of(" \t\"");
        return begin == std::string::npos ? "" : line.substr(begin, end + 1 - begin);
    }
    return "";
}

std::uint64_t kibibytes(const char* file, const std::string& key) {
    const std::string value = valueOf(file, key, ':');
    return value.empty() ? 0 : std::stoull(value) * 1024;
}

std::string now() {
    const std::time_t time = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&time, &utc);
    char text[sizeof "2000-01-01T00:00:00Z"];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

}  // namespace

int threadsAvailable() {
    return omp_get_num_procs();
}

ProcessMemory processMemory() {
    constexpr const char* FILE = "/proc/self/status";
    return {kibibytes(FILE, "VmRSS"), kibibytes(FILE, "VmHWM")};
}

SystemInfo systemInfo() {
    utsname kernel{};
    uname(&kernel);
    return {
        .cpu = valueOf("/proc/cpuinfo", "model name", ':'),
        .cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)),
        .threadsAvailable = threadsAvailable(),
        .memoryBytes = kibibytes("/proc/meminfo", "MemTotal"),
        .os = valueOf("/etc/os-release", "PRETTY_NAME", '=') + ", " + kernel.sysname + " " +
              kernel.release,
        .date = now(),
    };
}

}  // namespace bwfirt
