// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/sah-bvh/Builder.h"

#include "kernel/KernelArray.h"
#include "kernel/sah-bvh/Binning.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace bwfirt {

namespace {

class Builder {
  public:
    Builder(std::span<const Triangle> triangles, Arena& arena)
        : triangles_(triangles), arena_(arena) {}

    const Node* build() {
        const std::size_t count = triangles_.size();
        const auto memory = makeKernelArray<Reference>(count);
        Reference* const references = memory.get();
#pragma omp parallel for
        for (std::size_t i = 0; i < count; ++i)
            new (&references[i]) Reference(triangles_[i], static_cast<std::uint32_t>(i));

        Child root(static_cast<const Node*>(nullptr));
#pragma omp parallel
#pragma omp single
        {
            Reference* const end =
                partition(references, references + count,
                          [](const Reference& reference) { return !reference.box().isEmpty(); });
            if (references != end)
                buildOrFail(root, rangeOf(references, end), 0);
        }
        if (isOutOfMemory_)
            throw std::bad_alloc();
        return root.node();
    }

  private:
    /// From this depth on ranges are halved, which takes at most 32 more levels.
    static constexpr int MAX_SAH_DEPTH = MAX_DEPTH - 32;

    /// No exception may leave a task.
    void buildOrFail(Child& child, const Range& range, int depth) {
        try {
            child = Child(buildNode(range, depth));
        } catch (const std::bad_alloc&) {
            isOutOfMemory_ = true;
        }
    }

    const Node* buildNode(const Range& range, int depth) {
        std::array<Range, Node::WIDTH> parts;
        parts[0] = range;
        std::size_t count = 1;
        while (count < Node::WIDTH) {
            Range* const part = largestToSplit(std::span(parts.data(), count));
            if (part == nullptr)
                break;
            std::tie(*part, parts[count++]) = split(*part, depth);
        }

        Node* const node = arena_.make<Node>();
        for (std::size_t i = 0; i < count; ++i) {
            const Range& part = parts[i];
            node->setBox(i, part.bounds);
            if (part.size() <= Triangle4::SIZE) {
                node->children[i] = Child(makeLeaf(part));
            } else if (part.size() <= TASK_SIZE) {
                node->children[i] = Child(buildNode(part, depth + 1));
            } else {
#pragma omp task firstprivate(part, i)
                buildOrFail(node->children[i], part, depth + 1);
            }
        }
        return node;
    }

    /// Rays meet a part as often as its surface is large.
    static Range* largestToSplit(std::span<Range> parts) {
        Range* largest = nullptr;
        double mostArea = -1;
        for (Range& part : parts) {
            const double area = part.bounds.halfArea();
            if (part.size() > Triangle4::SIZE && area > mostArea) {
                mostArea = area;
                largest = &part;
            }
        }
        return largest;
    }

    static std::pair<Range, Range> split(const Range& range, int depth) {
        Reference* middle = range.begin + range.size() / 2;
        if (depth < MAX_SAH_DEPTH) {
            const Binning binning(range);
            const Binning::Split split = binning.bestSplit(range);
            if (std::isfinite(split.cost))
                middle = partition(range.begin, range.end, [&](const Reference& reference) {
                    return binning.isInFirst(split, reference);
                });
        }
        return {rangeOf(range.begin, middle), rangeOf(middle, range.end)};
    }

    const Triangle4* makeLeaf(const Range& range) {
        std::array<std::uint32_t, Triangle4::SIZE> indices;
        std::transform(range.begin, range.end, indices.begin(),
                       [](const Reference& reference) { return reference.triangle(); });
        return arena_.make<Triangle4>(triangles_, std::span(indices.data(), range.size()));
    }

    std::span<const Triangle> triangles_;
    Arena& arena_;
    std::atomic<bool> isOutOfMemory_ = false;
};

}  // namespace

const Node* buildBvh(std::span<const Triangle> triangles, Arena& arena) {
    return Builder(triangles, arena).build();
}

}  // namespace bwfirt
