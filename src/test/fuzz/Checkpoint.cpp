// SPDX-License-Identifier: GPL-3.0-only
#include "render/Checkpoint.h"

#include "scene/Checksum.h"
#include "scene/FileIO.h"
#include "test/fuzz/Fuzz.h"

#include <cstring>
#include <vector>

namespace bwfirt {
namespace {

const RunIdentity IDENTITY = {1, 2, 3, 2, 2, "kernel", "", ""};
constexpr std::size_t HEADER_BYTES = 176;

/// The file with the identity of the run and with the checksums that it should have: made-up bytes
/// alone hardly ever come that far. Offsets are those of doc/file-formats.
std::vector<std::uint8_t> withChecksums(std::span<const std::uint8_t> data) {
    Checkpoint(fuzz::folder() / "empty", IDENTITY).save(Film(2, 2), {}, 0);
    const std::string empty = readTextFile(fuzz::folder() / "empty");
    std::vector<std::uint8_t> file(data.begin(), data.end());
    file.resize(std::max(file.size(), HEADER_BYTES));
    for (const auto& [offset, size] : {std::pair{0, 12}, {16, 120}})
        std::memcpy(file.data() + offset, empty.data() + offset, static_cast<std::size_t>(size));
    const std::uint64_t sums =
        checksumOfBytes(file.data() + HEADER_BYTES, file.size() - HEADER_BYTES);
    std::memcpy(file.data() + 160, &sums, sizeof sums);
    const std::uint64_t header = checksumOfBytes(file.data(), 168);
    std::memcpy(file.data() + 168, &header, sizeof header);
    return file;
}

void check(std::span<const std::uint8_t> data) {
    Film film(IDENTITY.width, IDENTITY.height);
    RayCounts rays;
    double seconds = 0;
    const auto isLoaded = fuzz::readAsFile(data.data(), data.size(), [&](const auto& path) {
        return Checkpoint(path, IDENTITY).load(film, rays, seconds);
    });
    if (!isLoaded) {
        fuzz::require(film.passes() == 0 && rays.intersect == 0 && seconds == 0,
                      "what is refused changes nothing");
        return;
    }
    const std::filesystem::path path = fuzz::folder() / "written";
    Checkpoint(path, IDENTITY).save(film, rays, seconds);
    const std::string written = readTextFile(path);
    fuzz::require(
        written.size() == data.size() && std::memcmp(written.data(), data.data(), data.size()) == 0,
        "a checkpoint is the same when it is saved again");
}

}  // namespace
}  // namespace bwfirt

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    bwfirt::check({data, size});
    bwfirt::check(bwfirt::withChecksums({data, size}));
    return 0;
}
