// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Triangle4.h"
#include "kernel/sah-bvh/References.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace bwfirt {

/// The binned surface area heuristic. Wald: "On fast Construction of SAH-based Bounding Volume
/// Hierarchies", IEEE Symposium on Interactive Ray Tracing 2007.
class Binning {
  public:
    explicit Binning(const Range& range)
        : count_(std::min(MOST_BINS, 4 + range.size() / 8)),
          low_(range.centres.low),
          scale_(static_cast<float>(count_) / (range.centres.high - range.centres.low)) {}

    struct Split {
        double cost = std::numeric_limits<double>::infinity();
        std::size_t axis = 0;
        std::size_t bin = 0;  ///< the first one of the second part
    };

    Split bestSplit(const Range& range) const {
        const auto map = [&](const Reference* from, const Reference* to) {
            Bins bins;
            for (const Reference* reference = from; reference < to; ++reference) {
                const Box box = reference->box();
                const Ints4 binOf = binsOf(box);
                for (int axis = 0; axis < 3; ++axis) {
                    Bin& bin = bins[std::size_t(axis)][std::size_t(int(binOf[axis]))];
                    bin.box.extend(box);
                    ++bin.count;
                }
            }
            return bins;
        };
        const Bins bins = inPieces(range.begin, range.end, map, [](Bins first, const Bins& second) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < MOST_BINS; ++i) {
                    first[axis][i].box.extend(second[axis][i].box);
                    first[axis][i].count += second[axis][i].count;
                }
            return first;
        });
        Split best;
        for (std::size_t axis = 0; axis < 3; ++axis)
            improve(best, axis, bins[axis]);
        return best;
    }

    bool isInFirst(const Split& split, const Reference& reference) const {
        const int axis = static_cast<int>(split.axis);
        const float position = (reference.centre(axis) - low_[axis]) * scale_[axis];
        return !(position >= static_cast<float>(split.bin));
    }

  private:
    static constexpr std::size_t MOST_BINS = 16;

    struct Bin {
        Box box;
        std::size_t count = 0;
    };
    using AxisBins = std::array<Bin, MOST_BINS>;
    using Bins = std::array<AxisBins, 3>;

    /// The bins of a box along each of the axes.
    Ints4 binsOf(const Box& box) const {
        const Floats4 position = (box.centre() - low_) * scale_;
        const Floats4 last(static_cast<float>(count_ - 1));
        // A NaN becomes 0, too: all centres may be the same.
        return static_simd_cast<Ints4>(min(max(position, Floats4(0)), last));
    }

    /// A leaf of up to four triangles takes the time of one. An empty part is no split.
    static double cost(const Bin& part) {
        if (part.count == 0)
            return std::numeric_limits<double>::infinity();
        const std::size_t leaves = (part.count + Triangle4::SIZE - 1) / Triangle4::SIZE;
        return part.box.halfArea() * static_cast<double>(leaves);
    }

    void improve(Split& best, std::size_t axis, const AxisBins& bins) const {
        std::array<double, MOST_BINS> costsOfSecond;
        Bin second;
        for (std::size_t i = count_ - 1; i > 0; --i) {
            second.box.extend(bins[i].box);
            second.count += bins[i].count;
            costsOfSecond[i] = cost(second);
        }
        Bin first;
        for (std::size_t i = 1; i < count_; ++i) {
            first.box.extend(bins[i - 1].box);
            first.count += bins[i - 1].count;
            const double costOfBoth = cost(first) + costsOfSecond[i];
            if (costOfBoth < best.cost)
                best = {costOfBoth, axis, i};
        }
    }

    std::size_t count_;
    Floats4 low_;
    Floats4 scale_;
};

}  // namespace bwfirt
