// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace bwfirt::test {

/// True where the counts may come from bins of these probabilities, by Pearson's chi-square test.
/// The statistic of right counts has mean k and variance 2k with k = bins - 1; five standard
/// deviations are passed by fewer than one in a hundred thousand. The seeds of tests are fixed, so
/// that a test which passes once passes always.
inline bool fits(std::span<const std::size_t> counts, std::span<const double> probabilities) {
    double samples = 0;
    for (const std::size_t count : counts)
        samples += static_cast<double>(count);
    double chiSquare = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double expected = samples * probabilities[i];
        const double difference = static_cast<double>(counts[i]) - expected;
        chiSquare += difference * difference / expected;
    }
    const double k = static_cast<double>(counts.size()) - 1;
    return chiSquare < k + 5 * std::sqrt(2 * k);
}

}  // namespace bwfirt::test
