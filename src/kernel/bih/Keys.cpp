// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/bih/Keys.h"

#include "kernel/bih/Grid.h"

#include <omp.h>

#include <array>
#include <utility>

namespace bwfirt {

namespace {

constexpr std::size_t BUCKETS = std::size_t{1} << KeyFormat::BUCKET_BITS;
constexpr Key NO_KEY = ~Key{0};

/// A part of the triangles that a thread works on.
struct alignas(64) Piece {
    std::size_t begin;
    std::size_t end;
    Box centres;                                ///< their bounds
    std::array<std::uint32_t, BUCKETS> places;  ///< how many keys in each bucket, then where
};

Box boundsOfCentres(std::span<const Triangle> triangles) {
    Box bounds;
    for (const Triangle& triangle : triangles) {
        const Floats4 centre = centreOf(triangle);
        if (all_of(centre - centre == 0))
            bounds.extend({centre, centre});
    }
    return bounds;
}

Key keyOf(const Triangle& triangle, std::size_t index, const Grid& grid, const KeyFormat& format) {
    if (!hasArea(triangle))
        return NO_KEY;
    return format.make(grid.cellAround(centreOf(triangle)), static_cast<std::uint32_t>(index));
}

}  // namespace

Floats4 centreOf(const Triangle& triangle) {
    const V3f &a = triangle.vertices[0], &b = triangle.vertices[1], &c = triangle.vertices[2];
    return Floats4([&](auto i) {
        if constexpr (i == 3)
            return 0.0F;
        else
            return 0.5F * std::min({a[i], b[i], c[i]}) + 0.5F * std::max({a[i], b[i], c[i]});
    });
}

Keys makeKeys(std::span<const Triangle> triangles, const KeyFormat& format) {
    const std::size_t count = triangles.size();
    KernelVector<Piece> pieces(4 * static_cast<std::size_t>(omp_get_max_threads()));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces[i].begin = count * i / pieces.size();
        pieces[i].end = count * (i + 1) / pieces.size();
    }
    Keys result{makeKernelArray<Key>(count), makeKernelArray<Key>(count), 0};
    Key* const keys = result.keys.get();
    Key* const unsorted = result.buffer.get();

#pragma omp parallel for schedule(dynamic)
    for (Piece& piece : pieces)
        piece.centres = boundsOfCentres(triangles.subspan(piece.begin, piece.end - piece.begin));
    Box centres;
    for (const Piece& piece : pieces)
        centres.extend(piece.centres);
    const Grid grid(centres, format.axisBits());

    const int shift = format.bucketShift();
#pragma omp parallel for schedule(dynamic)
    for (Piece& piece : pieces)
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            const Key key = unsorted[i] = keyOf(triangles[i], i, grid, format);
            if (key != NO_KEY)
                ++piece.places[key >> shift];
        }
    std::uint32_t next = 0;
    for (std::size_t bucket = 0; bucket < BUCKETS; ++bucket)
        for (Piece& piece : pieces)
            next += std::exchange(piece.places[bucket], next);
    result.size = next;

#pragma omp parallel for schedule(dynamic)
    for (Piece& piece : pieces)
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            const Key key = unsorted[i];
            if (key != NO_KEY)
                keys[piece.places[key >> shift]++] = key;
        }
    return result;
}

void sortBucket(std::span<Key> keys, Key* buffer, const KeyFormat& format) {
    constexpr std::size_t FEW = 64;
    if (keys.size() <= FEW) {
        std::ranges::sort(keys);
        return;
    }
    // A radix sort, from the least significant digit on.
    constexpr int DIGIT_BITS = 8;
    constexpr std::size_t DIGITS = std::size_t{1} << DIGIT_BITS;
    Key* from = keys.data();
    Key* to = buffer;
    for (int shift = format.triangleBits(); shift < format.bucketShift(); shift += DIGIT_BITS) {
        const auto digitOf = [shift](Key key) { return key >> shift & (DIGITS - 1); };
        std::array<std::uint32_t, DIGITS> places{};
        for (std::size_t i = 0; i < keys.size(); ++i)
            ++places[digitOf(from[i])];
        std::uint32_t next = 0;
        for (std::uint32_t& place : places)
            next += std::exchange(place, next);
        for (std::size_t i = 0; i < keys.size(); ++i)
            to[places[digitOf(from[i])]++] = from[i];
        std::swap(from, to);
    }
    if (from != keys.data())
        std::copy_n(from, keys.size(), keys.data());
}

}  // namespace bwfirt
