// SPDX-License-Identifier: GPL-3.0-only
#include "render/Renderer.h"

#include <algorithm>
#include <exception>
#include <random>
#include <vector>

namespace bwfirt {

namespace {

/// The samples of a tile, a row after the other, before they are traced.
void dealSamples(const Film& film, std::uint64_t seed, int tile, std::vector<Sample>& samples) {
    constexpr int SIZE = Renderer::TILE_SIZE;
    const int tilesAcross = (film.width() + SIZE - 1) / SIZE;
    const int xBegin = tile % tilesAcross * SIZE, xEnd = std::min(xBegin + SIZE, film.width());
    const int yBegin = tile / tilesAcross * SIZE, yEnd = std::min(yBegin + SIZE, film.height());

    std::seed_seq identity{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(film.passes()),
                           static_cast<std::uint32_t>(tile)};
    std::mt19937 dealer(identity);
    samples.clear();
    for (int y = yBegin; y < yEnd; ++y) {
        for (int x = xBegin; x < xEnd; ++x) {
            const std::uint64_t high = dealer();
            samples.push_back({x, y, high << 32 | dealer(), {}});
        }
    }
}

}  // namespace

RayCounts Renderer::renderPass(Film& film) const {
    const auto tilesAlong = [](int length) { return (length + TILE_SIZE - 1) / TILE_SIZE; };
    const int tiles = tilesAlong(film.width()) * tilesAlong(film.height());
    std::vector<V3d> tileSums(static_cast<std::size_t>(tiles), V3d(0));
    RayCounts counts;
    std::exception_ptr failure;

#pragma omp parallel num_threads(threads_)
    {
        RayCounts threadCounts;
        std::vector<Sample> samples;
#pragma omp for schedule(dynamic) nowait
        for (int tile = 0; tile < tiles; ++tile) {
            try {
                dealSamples(film, seed_, tile, samples);
                integrator_.trace(samples, threadCounts);
                for (const Sample& sample : samples) {
                    film.add(sample.x, sample.y, sample.value);
                    tileSums[static_cast<std::size_t>(tile)] += sample.value;
                }
            } catch (...) {
#pragma omp critical
                failure = std::current_exception();
            }
        }
#pragma omp critical
        counts += threadCounts;
    }
    if (failure)
        std::rethrow_exception(failure);

    // Added in the order of the tiles, not in that in which the threads finish them.
    V3d sum(0);
    for (const V3d& tileSum : tileSums)
        sum += tileSum;
    film.endPass(sum / (static_cast<double>(film.width()) * film.height()));
    return counts;
}

}  // namespace bwfirt
