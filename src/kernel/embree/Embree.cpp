// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"

#include <embree3/rtcore.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace bwfirt {

namespace {

template <typename Handle, void release(Handle)>
struct Release {
    void operator()(Handle handle) const { release(handle); }
};
template <typename Handle, void release(Handle)>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<Handle, release>>;

using Device = Owned<RTCDevice, rtcReleaseDevice>;
using Geometry = Owned<RTCGeometry, rtcReleaseGeometry>;
using Scene = Owned<RTCScene, rtcReleaseScene>;

/// Embree leaves out what lies beyond, or asserts that there is none, since squares of larger
/// numbers are not finite.
constexpr float LARGEST_COORDINATE = 1e18F;

/// False for NaN, too.
bool isInReach(const V3f& vector) {
    return std::abs(vector.x) <= LARGEST_COORDINATE && std::abs(vector.y) <= LARGEST_COORDINATE &&
           std::abs(vector.z) <= LARGEST_COORDINATE;
}

bool canBeHit(const Triangle& triangle) {
    return hasArea(triangle) &&
           std::all_of(triangle.vertices.begin(), triangle.vertices.end(), isInReach);
}

class Embree : public RTKernel {
  public:
    std::vector<KernelOption> kernelOptions() const override {
        return {{"quality", isHigh_ ? "high" : "medium",
                 "of the tree: high builds longer, with spatial splits; or medium"},
                {"robust", isRobust_ ? "1" : "0",
                 "1 loses no hits at edges, and then quality=high is the same as medium; or 0"}};
    }

    void kernelSetOption(std::string_view name, const std::string& value) override {
        const bool isQuality = name == "quality";
        const std::string_view yes = isQuality ? "high" : "1", no = isQuality ? "medium" : "0";
        if (value != yes && value != no)
            throw std::invalid_argument("expected " + std::string(yes) + " or " + std::string(no));
        (isQuality ? isHigh_ : isRobust_) = value == yes;
    }

    std::string kernelDescription() const override { return description_; }

    void kernelInitialize(std::span<const Triangle> triangles) override {
        const std::string threads = "threads=" + std::to_string(omp_get_max_threads());
        device_.reset(rtcNewDevice(threads.c_str()));
        if (!device_)
            throw std::runtime_error("Embree does not start: error " +
                                     std::to_string(rtcGetDeviceError(nullptr)));
        rtcSetDeviceMemoryMonitorFunction(device_.get(), countMemory, nullptr);
        describe();

        scene_.reset(rtcNewScene(device_.get()));
        rtcSetSceneBuildQuality(scene_.get(),
                                isHigh_ ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
        rtcSetSceneFlags(scene_.get(), isRobust_ ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        attach(triangles);
        rtcCommitScene(scene_.get());
        const RTCError error = rtcGetDeviceError(device_.get());
        if (error == RTC_ERROR_OUT_OF_MEMORY)
            throw std::bad_alloc();
        if (error != RTC_ERROR_NONE)
            throw std::runtime_error("Embree cannot build its tree: error " +
                                     std::to_string(error));
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        if (!isInReach(ray.origin) || !isInReach(ray.direction))
            return std::nullopt;
        RTCRayHit query;
        query.ray = makeRay(ray.origin, ray.direction, std::numeric_limits<float>::infinity());
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return std::nullopt;
        return Hit{query.ray.tfar, triangleOf(query.hit.geomID, query.hit.primID)};
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const V3f direction = y - x;
        if (!isInReach(x) || !isInReach(direction))
            return true;
        // Embree's interval is closed at its end, the segment open.
        RTCRay segment = makeRay(x, direction, std::nextafter(1.0F, 0.0F));
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_.get(), &context, &segment);
        return segment.tfar >= 0;
    }

  private:
    enum GeometryId : unsigned { SHARED, LAST };
    using Indices = std::array<std::uint32_t, 3>;

    static bool countMemory(void*, ssize_t bytes, bool) {
        kernel_count(bytes);
        return true;
    }

    static RTCRay makeRay(const V3f& origin, const V3f& direction, float tFar) {
        RTCRay ray{};
        ray.org_x = origin.x;
        ray.org_y = origin.y;
        ray.org_z = origin.z;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.tfar = tFar;
        ray.mask = ~0U;
        return ray;
    }

    /// Embree names its code after the widest packets of rays that it has instructions for.
    void describe() {
        const auto property = [&](RTCDeviceProperty name) {
            return rtcGetDeviceProperty(device_.get(), name);
        };
        const char* const instructions =
            property(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)  ? "AVX-512"
            : property(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? "AVX or AVX2"
                                                                  : "SSE";
        description_ = "Embree";
        for (const auto part :
             {RTC_DEVICE_PROPERTY_VERSION_MAJOR, RTC_DEVICE_PROPERTY_VERSION_MINOR,
              RTC_DEVICE_PROPERTY_VERSION_PATCH})
            description_ += (description_ == "Embree" ? ' ' : '.') + std::to_string(property(part));
        description_ += std::string(" with ") + instructions;
    }

    /// Embree reads four floats for each vertex, and behind the last one there is none. The last
    /// triangle is therefore a geometry of its own, a copy.
    void attach(std::span<const Triangle> triangles) {
        if (triangles.size() > std::numeric_limits<std::uint32_t>::max() / 3)
            throw std::length_error("Embree cannot number the vertices of so many triangles");
        if (triangles.empty())
            return;
        last_ = static_cast<std::uint32_t>(triangles.size() - 1);
        attachShared(triangles);
        if (canBeHit(triangles.back()))
            attachCopy(triangles.back());
    }

    /// All triangles but the last, as the geometry 0.
    void attachShared(std::span<const Triangle> triangles) {
        const auto canBe = [&](std::uint32_t i) { return canBeHit(triangles[i]); };
        KernelVector<std::uint32_t> numbers(last_);
        std::iota(numbers.begin(), numbers.end(), 0U);
        numbers.erase(std::remove_if(numbers.begin(), numbers.end(), std::not_fn(canBe)),
                      numbers.end());
        if (numbers.empty())
            return;

        const Geometry geometry = newTriangles();
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   triangles.data(), 0, sizeof(V3f), 3 * std::size_t{last_});
        Indices* const indices =
            newBuffer<Indices>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, numbers.size());
        std::transform(numbers.begin(), numbers.end(), indices, [](std::uint32_t number) {
            return Indices{3 * number, 3 * number + 1, 3 * number + 2};
        });
        attach(geometry, SHARED);
        if (numbers.size() < last_)
            numbers_ = std::move(numbers);
    }

    void attachCopy(const Triangle& triangle) {
        const Geometry geometry = newTriangles();
        V3f* const vertices =
            newBuffer<V3f>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3);
        std::copy(triangle.vertices.begin(), triangle.vertices.end(), vertices);
        Indices* const indices =
            newBuffer<Indices>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 1);
        *indices = {0, 1, 2};
        attach(geometry, LAST);
    }

    Geometry newTriangles() const {
        return Geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    }

    template <typename Element>
    static Element* newBuffer(const Geometry& geometry, RTCBufferType type, RTCFormat format,
                              std::size_t count) {
        void* const buffer =
            rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, sizeof(Element), count);
        if (buffer == nullptr)
            throw std::bad_alloc();
        return static_cast<Element*>(buffer);
    }

    void attach(const Geometry& geometry, unsigned id) {
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene_.get(), geometry.get(), id);
    }

    std::uint32_t triangleOf(unsigned geometry, unsigned primitive) const {
        if (geometry == LAST)
            return last_;
        return numbers_.empty() ? primitive : numbers_[primitive];
    }

    bool isHigh_ = true;
    bool isRobust_ = false;
    std::string description_;
    std::uint32_t last_ = 0;               ///< of the triangles
    KernelVector<std::uint32_t> numbers_;  ///< of the triangles of SHARED; empty if they are all
    Device device_;
    Scene scene_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<Embree>();
}

}  // namespace bwfirt
