// SPDX-License-Identifier: GPL-3.0-only
#include "film/Film.h"

#include "scene/FileIO.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace bwfirt {

Film::Film(int width, int height) : width_(width), height_(height) {
    const std::size_t pixels = index(0, height);
    const std::size_t bytes = 2 * pixels * sizeof(V3d);
    const std::uintmax_t available = availableMemory();
    if (bytes > available)
        throw std::runtime_error("an image of " + std::to_string(width) + "x" +
                                 std::to_string(height) + " takes " + std::to_string(bytes) +
                                 " bytes, but only " + std::to_string(available) +
                                 " bytes of memory are left");
    sums_.total.assign(pixels, V3d(0));
    sums_.shard.assign(pixels, V3d(0));
}

void Film::endPass(const V3d& passAverage) {
    sums_.passAverages.push_back(passAverage);
    if (passes() % PASSES_PER_SHARD != 0)
        return;
    for (std::size_t i = 0; i < sums_.total.size(); ++i)
        sums_.total[i] += sums_.shard[i];
    sums_.shard.assign(sums_.shard.size(), V3d(0));
}

V3d Film::mean(int x, int y) const {
    if (passes() == 0)
        return V3d(0);
    const std::size_t i = index(x, y);
    return (sums_.total[i] + sums_.shard[i]) / passes();
}

V3d Film::averageIntensity() const {
    V3d sum(0);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            sum += mean(x, y);
    return sum / static_cast<double>(sums_.total.size());
}

V3d Film::standardError() const {
    const auto n = static_cast<double>(passes());
    V3d mean(0);
    for (const V3d& average : sums_.passAverages)
        mean += average / n;
    V3d squares(0);
    for (const V3d& average : sums_.passAverages)
        squares += (average - mean) * (average - mean);
    const V3d variance = squares / (n - 1) / n;
    return {std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z)};
}

}  // namespace bwfirt
