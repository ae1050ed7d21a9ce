// SPDX-License-Identifier: GPL-3.0-only
#include "render/RayStream.h"

#include "scene/Checksum.h"
#include "test/Shapes.h"
#include "test/fuzz/Fuzz.h"

#include <cstring>
#include <vector>

namespace bwfirt {
namespace {

const test::Triangles TRIANGLES = test::box(V3f(-1), V3f(1));

template <typename T>
void put(std::vector<std::uint8_t>& file, std::size_t offset, const T& value) {
    std::memcpy(file.data() + offset, &value, sizeof value);
}

/// The file with a header that fits these triangles and with the checksums that it should have:
/// made-up bytes alone hardly ever come that far. Offsets are those of doc/file-formats.
std::vector<std::uint8_t> withChecksums(std::span<const std::uint8_t> data) {
    std::vector<std::uint8_t> file(data.begin(), data.end());
    file.resize(std::max<std::size_t>(file.size(), 128));
    std::memcpy(file.data(), "bwfirays", 8);
    put(file, 8, std::uint32_t{1});
    put(file, 12, std::uint32_t{36});
    put(file, 32, std::uint64_t{TRIANGLES.size()});
    put(file, 40, checksumOf(TRIANGLES));
    put(file, 112, checksumOfBytes(file.data() + 128, file.size() - 128));
    put(file, 120, checksumOfBytes(file.data(), 120));
    return file;
}

void check(std::span<const std::uint8_t> data) {
    const auto stream = fuzz::readAsFile(
        data.data(), data.size(), [](const auto& path) { return readRayStream(path, TRIANGLES); });
    if (!stream)
        return;
    std::uint64_t intersect = 0, visibility = 0;
    for (const RayRecord& record : stream->records) {
        fuzz::require(record.question <= RayRecord::VISIBILITY, "a question is h or V");
        fuzz::require(record.answer <= 1, "an answer is yes or no");
        ++(record.question == RayRecord::INTERSECT ? intersect : visibility);
    }
    fuzz::require(intersect == stream->counts.intersect && visibility == stream->counts.visibility,
                  "the header counts the questions");
    fuzz::require(data.size() == 128 + 36 * stream->records.size(), "all of the file is read");
}

}  // namespace
}  // namespace bwfirt

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    bwfirt::check({data, size});
    bwfirt::check(bwfirt::withChecksums({data, size}));
    return 0;
}
