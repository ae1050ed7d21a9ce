// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/KernelOption.h"
#include "math/Ray.h"
#include "scene/Triangle.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bwfirt {

/// Where a ray meets a triangle.
struct Hit {
    float distance = 0;          ///< t of origin + t * direction, t > 0
    std::uint32_t triangle = 0;  ///< index into the triangles of kernelInitialize
};

/// A ray tracing kernel: it answers the two questions that light transport asks a scene of
/// triangles, the ray shooting function h(x, omega) and the visibility V(x <-> y).
///
/// To write a kernel, copy the folder src/kernel/yourkernel to src/kernel/<name> and change the
/// copy. `scons` then builds build/bwfirt-<name>; nothing else has to be edited. A kernel derives
/// from this class, overrides the two pure functions and defines createKernel() below.
///
/// What the framework does, in this order:
///   1. createKernel()
///   2. kernelSetOption() for each --kernel-option of the user
///   3. kernelInitialize(), once, from one thread; it is timed and may use all threads of OpenMP
///   4. queries, from many threads at once, in any order, each ray unrelated to the one before
///   5. the destructor; every byte of kernel_malloc() has been given back after it
///
/// A kernel knows the triangles and the queries, never the camera, the lights or the renderer.
///
/// What a right answer is:
///   - Triangles have two sides, and either side is hit.
///   - Triangles without area, or with a coordinate that is infinite or NaN, are never hit, and do
///     not disturb those beside them.
///   - Any float is a legal coordinate, and any number of triangles, 0 too, a legal scene.
///   - A ray with a NaN in it hits nothing; a segment with a NaN in it is unobstructed.
///   - There is no epsilon: a hit counts for every t > 0, however small. The renderer moves the
///     start of each ray, and the far end of each segment, off the surface by NORMAL_OFFSET. A
///     kernel with an epsilon of its own changes the image and cannot be compared with others.
///   - A ray through an edge or vertex that triangles share should hit one of them.
class RTKernel {
  public:
    /// Distance, in scene units, by which the renderer moves points off a surface along its normal
    /// before it asks about them. The same for all kernels. For information: a kernel needs no
    /// epsilon.
    static constexpr double NORMAL_OFFSET = 1e-4;

    RTKernel() = default;
    RTKernel(const RTKernel&) = delete;
    RTKernel& operator=(const RTKernel&) = delete;
    virtual ~RTKernel() = default;

    /// Builds the acceleration structure. The triangles stay where they are, unchanged, until the
    /// kernel is destroyed, so that a kernel may refer to them instead of copying; they are not
    /// counted as its memory. May throw, std::bad_alloc for instance: the run has then failed.
    virtual void kernelInitialize(std::span<const Triangle> triangles) = 0;

    /// The ray shooting function h(x, omega): the nearest hit among all t in (0, infinity), nothing
    /// where the ray leaves the scene. Where several triangles are hit at the same distance, any of
    /// them. Called from many threads at once; must not throw.
    virtual std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const = 0;

    /// The visibility V(x <-> y): true where no triangle meets the open segment between x and y.
    /// Not overridden, it is a front end to h. One's own is usually faster, since any hit will do.
    /// Called from many threads at once; must not throw.
    virtual bool kernelVisibility(const V3f& x, const V3f& y) const;

    /// h for many independent rays at once: hits[i] answers rays[i]. The spans have the same
    /// length. Not overridden, it asks ray by ray. A kernel that works on several rays in turn can
    /// hide the latency of memory behind them. The renderer calls it only under --in-flight.
    virtual void kernelIntersectMany(std::span<const Ray> rays,
                                     std::span<std::optional<Hit>> hits) const;

    /// V for many independent segments at once: visible[i] answers segments[i].
    struct Segment {
        V3f x;
        V3f y;
    };
    virtual void kernelVisibleMany(std::span<const Segment> segments,
                                   std::span<bool> visible) const;

    /// The settings that the kernel offers, with their values. None by default.
    virtual std::vector<KernelOption> kernelOptions() const { return {}; }

    /// Changes a setting, one of kernelOptions(), before kernelInitialize().
    /// @throws std::invalid_argument saying which values there are, where this is none of them
    virtual void kernelSetOption(std::string_view name, const std::string& value);

    /// What the kernel has to say of itself in the report, the version of a library for instance.
    /// Asked for after kernelInitialize().
    virtual std::string kernelDescription() const { return {}; }

    /// The counting allocators: memory that a kernel takes from them is reported as its own. Use
    /// them, or KernelAllocator for standard containers, for everything that grows with the scene;
    /// the report warns of kernels that do not. They may be called from many threads at once.
    ///
    /// kernel_malloc returns at least `bytes` bytes at an address that is a multiple of
    /// `alignment`, a power of two. @throws std::bad_alloc
    static void* kernel_malloc(std::size_t bytes, std::size_t alignment = 16);

    /// Grows or shrinks what kernel_malloc returned, keeping its content and alignment; the
    /// address may change. A null pointer is allocated anew. @throws std::bad_alloc, and then the
    /// old memory is as it was
    static void* kernel_realloc(void* pointer, std::size_t bytes);

    /// Gives back what kernel_malloc or kernel_realloc returned. A null pointer is ignored.
    static void kernel_free(void* pointer);

    /// Counts bytes that a library has allocated for the kernel, or, where negative, given back:
    /// for libraries that allocate for themselves and tell how much.
    static void kernel_count(std::ptrdiff_t bytes);
};

/// Lets standard containers count as the kernel's memory:
/// `std::vector<Node, KernelAllocator<Node>> nodes_;`
template <typename T>
struct KernelAllocator {
    using value_type = T;

    KernelAllocator() = default;
    template <typename U>
    KernelAllocator(const KernelAllocator<U>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T))
            throw std::bad_alloc();
        return static_cast<T*>(RTKernel::kernel_malloc(count * sizeof(T), alignof(T)));
    }
    void deallocate(T* pointer, std::size_t) noexcept { RTKernel::kernel_free(pointer); }

    bool operator==(const KernelAllocator&) const { return true; }
};

/// A vector whose memory counts as the kernel's.
template <typename T>
using KernelVector = std::vector<T, KernelAllocator<T>>;

/// Every kernel folder defines this function, and the executable of that kernel calls it once.
std::unique_ptr<RTKernel> createKernel();

}  // namespace bwfirt
