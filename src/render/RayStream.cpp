// SPDX-License-Identifier: GPL-3.0-only
#include "render/RayStream.h"

#include "render/FileHeader.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace bwfirt {

namespace {

constexpr std::size_t BUFFERED_RECORDS = 1 << 15;

/// The beginning of a file, as doc/file-formats describes it. The records follow.
struct Header {
    static constexpr std::array<char, 8> MAGIC = {'b', 'w', 'f', 'i', 'r', 'a', 'y', 's'};
    static constexpr std::uint32_t VERSION = 1;

    std::array<char, 8> magic = MAGIC;
    std::uint32_t version = VERSION;
    std::uint32_t recordBytes = sizeof(RayRecord);
    std::uint64_t intersect = 0;
    std::uint64_t visibility = 0;
    std::uint64_t triangles = 0;
    std::uint64_t trianglesChecksum = 0;
    std::array<char, 64> kernel{};  ///< filled up with zeros
    std::uint64_t recordsChecksum = 0;
    std::uint64_t headerChecksum = 0;
};
static_assert(sizeof(Header) == 128);

std::string_view bytesOf(const Header& header) {
    return {reinterpret_cast<const char*>(&header), sizeof header};
}

std::uint16_t atMost65535(int bounce) {
    return static_cast<std::uint16_t>(std::min(bounce, 65535));
}

}  // namespace

std::uint64_t checksumOf(std::span<const Triangle> triangles) {
    return checksumOfBytes(triangles.data(), triangles.size_bytes());
}

RayStream readRayStream(const std::filesystem::path& path, std::span<const Triangle> triangles) {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(path.string() + ": " + what);
    };
    const std::uintmax_t bytes = inputFileSize(path);
    const auto header = readHeader<Header>(path, bytes, "a ray stream");
    if (header.recordBytes != sizeof(RayRecord))
        fail("has rays of " + std::to_string(header.recordBytes) + " bytes, not " +
             std::to_string(sizeof(RayRecord)));
    if (header.triangles != triangles.size() || header.trianglesChecksum != checksumOf(triangles))
        fail("was recorded on other triangles than those of the scene");

    const std::uintmax_t recordBytes = bytes - sizeof header;
    const std::uintmax_t count = recordBytes / sizeof(RayRecord);
    if (recordBytes % sizeof(RayRecord) != 0 || header.intersect > count ||
        header.visibility != count - header.intersect)
        fail("is damaged: its size does not fit the numbers in its header");
    if (bytes > availableMemory())
        fail(std::to_string(count) + " rays take " + std::to_string(bytes) +
             " bytes, and that is more than the memory that is left");

    RayStream stream;
    stream.kernel.assign(header.kernel.begin(),
                         std::find(header.kernel.begin(), header.kernel.end(), '\0'));
    stream.counts = {header.intersect, header.visibility};
    stream.records.resize(count);
    readBytes(path, stream.records.data(), recordBytes, sizeof header);
    if (checksumOfBytes(stream.records.data(), recordBytes) != header.recordsChecksum)
        fail("is damaged: its rays do not fit their checksum");

    std::uint64_t intersect = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const RayRecord& record = stream.records[i];
        if (record.question > RayRecord::VISIBILITY || record.answer > 1)
            fail("ray " + std::to_string(i) + " is neither a question h nor a question V");
        intersect += record.question == RayRecord::INTERSECT ? 1 : 0;
    }
    if (intersect != header.intersect)
        fail("is damaged: its header counts other rays");
    return stream;
}

RayStreamWriter::RayStreamWriter(const std::filesystem::path& path,
                                 std::span<const Triangle> triangles, const std::string& kernel,
                                 std::uint64_t most)
    : file_(path), triangles_(triangles), kernel_(kernel), most_(most) {
    buffer_.reserve(BUFFERED_RECORDS);
    file_.write(bytesOf({}));
}

void RayStreamWriter::intersected(const Ray& ray, int bounce, const std::optional<Hit>& hit) {
    RayRecord record{ray.origin, ray.direction};
    if (hit) {
        record.distance = hit->distance;
        record.triangle = hit->triangle;
    }
    record.bounce = atMost65535(bounce);
    record.question = RayRecord::INTERSECT;
    record.answer = hit ? 1 : 0;
    add(record);
}

void RayStreamWriter::connected(const V3f& x, const V3f& y, int bounce, bool isVisible) {
    RayRecord record{x, y};
    record.bounce = atMost65535(bounce);
    record.question = RayRecord::VISIBILITY;
    record.answer = isVisible ? 1 : 0;
    add(record);
}

void RayStreamWriter::add(const RayRecord& record) {
    if (isFull())
        return;
    buffer_.push_back(record);
    ++(record.question == RayRecord::INTERSECT ? counts_.intersect : counts_.visibility);
    if (buffer_.size() == BUFFERED_RECORDS)
        flush();
}

void RayStreamWriter::flush() {
    const std::size_t bytes = buffer_.size() * sizeof(RayRecord);
    checksum_.addBytes(buffer_.data(), bytes);
    file_.write({reinterpret_cast<const char*>(buffer_.data()), bytes});
    buffer_.clear();
}

void RayStreamWriter::finish() {
    flush();
    Header header;
    header.intersect = counts_.intersect;
    header.visibility = counts_.visibility;
    header.triangles = triangles_.size();
    header.trianglesChecksum = checksumOf(triangles_);
    std::copy_n(kernel_.begin(), std::min(kernel_.size(), header.kernel.size() - 1),
                header.kernel.begin());
    header.recordsChecksum = checksum_.value();
    header.headerChecksum = checksumOfHeader(header);
    file_.overwriteBeginning(bytesOf(header));
    file_.commit();
}

}  // namespace bwfirt
