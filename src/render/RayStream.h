// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "render/PathTracer.h"
#include "render/RayCounts.h"
#include "scene/Checksum.h"
#include "scene/FileIO.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bwfirt {

/// A question of the path tracer and a kernel's answer to it.
struct RayRecord {
    enum Question : std::uint8_t { INTERSECT = 0, VISIBILITY = 1 };

    V3f a;                       ///< h: origin of the ray; V: x
    V3f b;                       ///< h: direction of the ray; V: y
    float distance = 0;          ///< h: of the hit, 0 without one; V: 0
    std::uint32_t triangle = 0;  ///< h: that is hit, 0 without a hit; V: 0
    std::uint16_t bounce = 0;    ///< surfaces that the path met before; 65535 stands for more, too
    Question question = INTERSECT;
    std::uint8_t answer = 0;  ///< h: 1 where there is a hit; V: 1 where x sees y

    Ray ray() const { return {a, b}; }
    std::optional<Hit> hit() const {
        return answer != 0 ? std::optional<Hit>({distance, triangle}) : std::nullopt;
    }
};
static_assert(sizeof(RayRecord) == 36, "a record is stored as it is, without padding");

/// What a renderer asked, in this order, and what the recording kernel answered.
struct RayStream {
    std::string kernel;  ///< that answered
    std::vector<RayRecord> records;
    RayCounts counts;
};

/// Tells the triangles of one scene from those of another.
std::uint64_t checksumOf(std::span<const Triangle> triangles);

/// Reads a stream that was recorded on these triangles.
/// @throws std::runtime_error "<file>: <what is wrong>" where the file is no stream, is damaged, or
///         was recorded on other triangles
RayStream readRayStream(const std::filesystem::path& path, std::span<const Triangle> triangles);

/// Writes a stream as it comes, and makes it a file in the end.
class RayStreamWriter : public RayListener {
  public:
    /// @param most records that are kept; later ones are dropped
    RayStreamWriter(const std::filesystem::path& path, std::span<const Triangle> triangles,
                    const std::string& kernel, std::uint64_t most);

    void intersected(const Ray& ray, int bounce, const std::optional<Hit>& hit) override;
    void connected(const V3f& x, const V3f& y, int bounce, bool isVisible) override;

    bool isFull() const { return counts_.intersect + counts_.visibility == most_; }

    /// Without this call there is no file.
    void finish();

  private:
    void add(const RayRecord& record);
    void flush();

    AtomicFile file_;
    std::span<const Triangle> triangles_;
    std::string kernel_;
    std::uint64_t most_;
    RayCounts counts_;
    Checksum checksum_;
    std::vector<RayRecord> buffer_;
};

/// A path tracer whose questions and answers go to a stream. For one thread only.
class RecordingPathTracer : public Integrator {
  public:
    RecordingPathTracer(const PathTracer& pathTracer, RayStreamWriter& stream)
        : pathTracer_(pathTracer), stream_(stream) {}

    void trace(std::span<Sample> samples, RayCounts& counts) const override {
        pathTracer_.trace(samples, counts, stream_);
    }

  private:
    const PathTracer& pathTracer_;
    RayStreamWriter& stream_;
};

}  // namespace bwfirt
