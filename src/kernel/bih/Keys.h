// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/KernelArray.h"
#include "kernel/Simd4.h"
#include "scene/Triangle.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace bwfirt {

/// The number of the grid's cell in which the centre of a triangle's box lies, in the upper bits,
/// and the triangle in the lower ones. The order of keys is that of the cells.
using Key = std::uint64_t;

/// How keys are made up for a number of triangles.
class KeyFormat {
  public:
    explicit KeyFormat(std::size_t triangleCount)
        : triangleBits_(std::bit_width(triangleCount)),
          axisBits_(std::min(MOST_AXIS_BITS, (64 - triangleBits_) / 3)) {}

    int triangleBits() const { return triangleBits_; }
    /// Of a grid: it has 2^axisBits cells along an axis.
    int axisBits() const { return axisBits_; }
    /// Keys with the same upper bits, from here on, are in one bucket.
    int bucketShift() const { return triangleBits_ + 3 * axisBits_ - BUCKET_BITS; }

    Key make(Key cell, std::uint32_t triangle) const { return cell << triangleBits_ | triangle; }
    Key cell(Key key) const { return key >> triangleBits_; }
    std::uint32_t triangle(Key key) const {
        return static_cast<std::uint32_t>(key & ((Key{1} << triangleBits_) - 1));
    }

    static constexpr int BUCKET_BITS = 12;

  private:
    static constexpr int MOST_AXIS_BITS = 13;

    int triangleBits_;
    int axisBits_;
};

/// The centre of the triangle's box, or a point close to it.
Floats4 centreOf(const Triangle& triangle);

/// Keys of the triangles that can be hit, in the order of their buckets.
struct Keys {
    KernelArray<Key> keys;
    KernelArray<Key> buffer;  ///< of the same size
    std::size_t size;
};
Keys makeKeys(std::span<const Triangle> triangles, const KeyFormat& format);

/// Sorts keys of one bucket. Afterwards there is anything in the buffer, which has the same size.
void sortBucket(std::span<Key> keys, Key* buffer, const KeyFormat& format);

}  // namespace bwfirt
