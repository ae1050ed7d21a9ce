// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/qbvh/Split.h"

#include "kernel/qbvh/Node.h"

#include <algorithm>
#include <array>
#include <vector>

namespace bwfirt {

namespace {

/// Groups of more references are worked on by several threads, a piece at a time.
constexpr std::size_t PIECE = 1 << 14;

constexpr std::size_t MOST_BINS = 32;

std::span<Reference> piece(std::span<Reference> references, std::size_t index) {
    const std::size_t begin = index * PIECE;
    return references.subspan(begin, std::min(PIECE, references.size() - begin));
}

/// Calls work(piece, result) for the pieces of a group and merges the results into one.
template <typename Result, typename Work>
Result forPieces(std::span<Reference> references, const Work& work) {
    const std::size_t count = (references.size() + PIECE - 1) / PIECE;
    if (count <= 1) {
        Result result;
        work(references, result);
        return result;
    }
    std::vector<Result> results(count);
#pragma omp taskloop default(none) shared(references, work, results) firstprivate(count)
    for (std::size_t i = 0; i < count; ++i)
        work(piece(references, i), results[i]);
    for (std::size_t i = 1; i < count; ++i)
        results[0].merge(results[i]);
    return results[0];
}

/// The references whose centres lie in one slice of the group.
struct Bin {
    Box bounds;
    std::size_t count = 0;

    void merge(const Bin& other) {
        bounds.extend(other.bounds);
        count += other.count;
    }
};

/// The slices along the three axes.
struct Bins {
    std::array<std::array<Bin, MOST_BINS>, 3> bins;

    void merge(const Bins& other) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < MOST_BINS; ++i)
                bins[axis][i].merge(other.bins[axis][i]);
    }
};

/// Tells in which slice of a group a reference is.
class Slices {
  public:
    explicit Slices(const Group& group)
        : count_(std::min(MOST_BINS, 4 + group.size() / 16)), low_(group.centres.low) {
        const Floats4 length = group.centres.high - group.centres.low;
        for (int axis = 0; axis < 3; ++axis)
            perLength_[axis] =
                length[axis] > 0 ? static_cast<float>(count_) * 0.9999F / length[axis] : 0;
        // An infinite factor would make NaN of 0.
        perLength_ = min(perLength_, Floats4(std::numeric_limits<float>::max()));
    }

    std::size_t count() const { return count_; }
    bool isEmpty(int axis) const { return !(perLength_[axis] > 0); }

    using Ints4 = std::experimental::rebind_simd_t<int, Floats4>;
    Ints4 of(const Box& box) const {
        const Floats4 position = (box.low + box.high - low_) * perLength_;
        const Floats4 last = static_cast<float>(count_ - 1);
        return std::experimental::static_simd_cast<Ints4>(min(max(position, Floats4(0)), last));
    }

  private:
    std::size_t count_;
    Floats4 low_;
    Floats4 perLength_ = 0;
};

struct Plane {
    int axis;
    int firstOfSecond;  ///< slice
};

/// How many leaves take so many triangles.
double leaves(std::size_t count) {
    constexpr std::size_t MOST = LeafAddress::MOST_TRIANGLES;
    return static_cast<double>((count + MOST - 1) / MOST);
}

std::optional<Plane> cheapestPlane(const Bins& bins, const Slices& slices) {
    std::optional<Plane> cheapest;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (slices.isEmpty(axis))
            continue;
        const auto& row = bins.bins[static_cast<std::size_t>(axis)];
        std::array<double, MOST_BINS> costsAbove;
        Bin above, below;
        for (std::size_t i = slices.count() - 1; i > 0; --i) {
            above.merge(row[i]);
            costsAbove[i] = above.count == 0 ? std::numeric_limits<double>::infinity()
                                             : above.bounds.halfArea() * leaves(above.count);
        }
        for (std::size_t i = 1; i < slices.count(); ++i) {
            below.merge(row[i - 1]);
            if (below.count == 0)
                continue;
            const double cost = below.bounds.halfArea() * leaves(below.count) + costsAbove[i];
            if (cost < least) {
                least = cost;
                cheapest = Plane{axis, static_cast<int>(i)};
            }
        }
    }
    return cheapest;
}

/// Bounds of a group, without the group.
struct GroupBounds {
    Box bounds, centres;

    void merge(const GroupBounds& other) {
        bounds.extend(other.bounds);
        centres.extend(other.centres);
    }
};

}  // namespace

Group groupOf(std::span<Reference> references) {
    const auto found =
        forPieces<GroupBounds>(references, [](std::span<Reference> piece, GroupBounds& result) {
            Group group;
            for (const Reference& reference : piece)
                group.extend(reference);
            result = {group.bounds, group.centres};
        });
    return {references, found.bounds, found.centres};
}

std::optional<Parts> splitBySah(const Group& group) {
    const Slices slices(group);
    const Bins bins =
        forPieces<Bins>(group.references, [&](std::span<Reference> piece, Bins& result) {
            for (const Reference& reference : piece) {
                const Box box = reference.box();
                const auto slice = slices.of(box);
                for (int axis = 0; axis < 3; ++axis) {
                    Bin& bin = result.bins[static_cast<std::size_t>(axis)]
                                          [static_cast<std::size_t>(slice[axis])];
                    bin.bounds.extend(box);
                    ++bin.count;
                }
            }
        });
    const std::optional<Plane> plane = cheapestPlane(bins, slices);
    if (!plane)
        return std::nullopt;

    const auto isInFirst = [&](const Reference& reference) {
        return slices.of(reference.box())[plane->axis] < plane->firstOfSecond;
    };
    Parts parts;
    auto left = group.references.begin(), right = group.references.end();
    while (true) {
        while (left != right && isInFirst(*left))
            parts.first.extend(*left++);
        while (left != right && !isInFirst(*(right - 1)))
            parts.second.extend(*--right);
        if (left == right)
            break;
        std::swap(*left, *(right - 1));
    }
    parts.first.references = {group.references.begin(), left};
    parts.second.references = {left, group.references.end()};
    return parts;
}

Parts halve(const Group& group) {
    constexpr std::size_t MOST = LeafAddress::MOST_TRIANGLES;
    const std::size_t half = group.size() / 2;
    const std::size_t middle = half < MOST ? half : half / MOST * MOST;
    return {groupOf(group.references.first(middle)), groupOf(group.references.subspan(middle))};
}

}  // namespace bwfirt
