// SPDX-License-Identifier: GPL-3.0-only
#include "render/Checkpoint.h"

#include "render/FileHeader.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

namespace bwfirt {

namespace {

/// The beginning of a file, as doc/file-formats describes it. The sums follow.
struct Header {
    static constexpr std::array<char, 8> MAGIC = {'b', 'w', 'f', 'i', 'c', 'h', 'k', 'p'};
    static constexpr std::uint32_t VERSION = 1;

    std::array<char, 8> magic = MAGIC;
    std::uint32_t version = VERSION;
    std::uint32_t passes = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint64_t scene = 0;
    std::uint64_t camera = 0;
    std::uint64_t seed = 0;
    std::array<char, 64> kernel{};    ///< filled up with zeros
    std::uint64_t kernelOptions = 0;  ///< checksum
    std::array<char, 16> view{};      ///< filled up with zeros
    std::uint64_t intersect = 0;
    std::uint64_t visibility = 0;
    double secondsRender = 0;
    std::uint64_t sumsChecksum = 0;
    std::uint64_t headerChecksum = 0;
};
static_assert(sizeof(Header) == 176);

template <std::size_t SIZE>
std::array<char, SIZE> padded(const std::string& text) {
    std::array<char, SIZE> result{};
    std::copy_n(text.begin(), std::min(text.size(), SIZE), result.begin());
    return result;
}

Header headerOf(const RunIdentity& identity) {
    Header header;
    header.width = static_cast<std::uint32_t>(identity.width);
    header.height = static_cast<std::uint32_t>(identity.height);
    header.scene = identity.scene;
    header.camera = identity.camera;
    header.seed = identity.seed;
    header.kernel = padded<64>(identity.kernel);
    header.kernelOptions =
        checksumOfBytes(identity.kernelOptions.data(), identity.kernelOptions.size());
    header.view = padded<16>(identity.view);
    return header;
}

/// Nothing where both are headers of the same run.
std::string differenceBetween(const Header& a, const Header& b) {
    if (a.scene != b.scene)
        return "scene";
    if (a.camera != b.camera)
        return "camera";
    if (a.seed != b.seed)
        return "seed";
    if (a.width != b.width || a.height != b.height)
        return "size of the image";
    if (a.kernel != b.kernel)
        return "kernel";
    if (a.kernelOptions != b.kernelOptions)
        return "setting of the kernel's options";
    if (a.view != b.view)
        return "view";
    return "";
}

}  // namespace

std::uint64_t checksumOf(const Scene& scene) {
    Checksum sum;
    sum.addBytes(scene.triangles.data(), scene.triangles.size() * sizeof(Triangle));
    for (const Light& light : scene.lights) {
        sum.add(light.first);
        sum.add(light.last);
        sum.add(light.exitance);
    }
    sum.add(scene.reflectance);
    return sum.value();
}

std::uint64_t checksumOf(const Camera& camera) {
    Checksum sum;
    sum.add(camera.position);
    sum.add(camera.direction);
    sum.add(camera.up);
    sum.add(camera.depth);
    sum.add(camera.filmSizeY);
    sum.add(camera.sensorResponse);
    return sum.value();
}

void Checkpoint::save(const Film& film, const RayCounts& rays, double secondsRender) const {
    Header header = headerOf(identity_);
    const auto bytesOfHeader = [&]() -> std::string_view {
        return {reinterpret_cast<const char*>(&header), sizeof header};
    };
    AtomicFile file(path_);
    file.write(bytesOfHeader());
    Checksum sum;
    const auto write = [&](std::span<const V3d> values) {
        sum.addBytes(values.data(), values.size_bytes());
        file.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    };
    write(film.sums().total);
    write(film.sums().shard);
    write(film.sums().passAverages);
    header.passes = static_cast<std::uint32_t>(film.passes());
    header.intersect = rays.intersect;
    header.visibility = rays.visibility;
    header.secondsRender = secondsRender;
    header.sumsChecksum = sum.value();
    header.headerChecksum = checksumOfHeader(header);
    file.overwriteBeginning(bytesOfHeader());
    file.commit();
}

bool Checkpoint::load(Film& film, RayCounts& rays, double& secondsRender) const {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(path_.string() + ": " + what);
    };
    if (!std::filesystem::exists(path_))
        return false;
    const std::uintmax_t bytes = inputFileSize(path_);
    const auto header = readHeader<Header>(path_, bytes, "a checkpoint");
    if (const std::string difference = differenceBetween(header, headerOf(identity_));
        !difference.empty())
        fail("is the checkpoint of another run: its " + difference + " is not the same");

    FilmSums sums = film.sums();
    const std::uintmax_t pixels = sums.total.size();
    if (bytes != sizeof header + sizeof(V3d) * (2 * pixels + header.passes))
        fail("is damaged: its size does not fit the numbers in its header");
    sums.passAverages.resize(header.passes);
    std::uintmax_t offset = sizeof header;
    Checksum sum;
    for (std::vector<V3d>* values : {&sums.total, &sums.shard, &sums.passAverages}) {
        const std::uintmax_t size = values->size() * sizeof(V3d);
        readBytes(path_, values->data(), size, offset);
        sum.addBytes(values->data(), size);
        offset += size;
    }
    if (sum.value() != header.sumsChecksum)
        fail("is damaged: its sums do not fit their checksum");

    film.restore(std::move(sums));
    rays = {header.intersect, header.visibility};
    secondsRender = header.secondsRender;
    return true;
}

}  // namespace bwfirt
