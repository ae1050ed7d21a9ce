// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/Partition.h"

#include <utility>

namespace bwfirt::wide {

namespace {

/// Rows of references, counted through.
class Rows {
  public:
    void add(std::span<Reference> row) {
        rows_[count_] = row;
        before_[count_ + 1] = before_[count_] + row.size();
        ++count_;
    }
    std::size_t size() const { return before_[count_]; }

    /// The references from the given one on to the end of its row.
    std::span<Reference> from(std::size_t index) const {
        const auto next = std::upper_bound(before_.begin(), before_.begin() + count_, index);
        const auto row = static_cast<std::size_t>(next - before_.begin()) - 1;
        return rows_[row].subspan(index - before_[row]);
    }

  private:
    std::array<std::span<Reference>, Pieces::COUNT> rows_;
    std::array<std::size_t, Pieces::COUNT + 1> before_{};
    std::size_t count_ = 0;
};

}  // namespace

void exchange(std::span<Reference> references,
              const std::array<std::size_t, Pieces::COUNT>& belowOf, std::size_t middle) {
    const Pieces pieces(references.size());
    Rows above, below;
    for (std::size_t i = 0; i < Pieces::COUNT; ++i) {
        const std::size_t begin = pieces.begin(i), split = begin + belowOf[i], end = pieces.end(i);
        if (split < std::min(end, middle))
            above.add(references.subspan(split, std::min(end, middle) - split));
        if (std::max(begin, middle) < split)
            below.add(references.subspan(std::max(begin, middle), split - std::max(begin, middle)));
    }
    const Pieces swaps(above.size());
#pragma omp taskloop grainsize(1) default(shared)
    for (std::size_t i = 0; i < Pieces::COUNT; ++i)
        for (std::size_t k = swaps.begin(i); k < swaps.end(i);) {
            const std::span<Reference> a = above.from(k), b = below.from(k);
            const std::size_t length = std::min({a.size(), b.size(), swaps.end(i) - k});
            std::swap_ranges(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(length), b.begin());
            k += length;
        }
}

}  // namespace bwfirt::wide
