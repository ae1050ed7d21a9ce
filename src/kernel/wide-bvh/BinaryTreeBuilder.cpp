// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/BinaryTreeBuilder.h"

#include "kernel/KernelArray.h"
#include "kernel/wide-bvh/ObjectSplit.h"
#include "kernel/wide-bvh/Partition.h"
#include "kernel/wide-bvh/SpatialSplit.h"

#include <stdexcept>

namespace bwfirt::wide {

namespace {

/// A node to be built over references [begin, end), which with their parts may grow up to `room`.
struct Task {
    std::uint32_t node;
    std::size_t begin;
    std::size_t end;
    std::size_t room;
    Box box;
    Box halfCentres;
    int depth;

    std::size_t size() const { return end - begin; }
};

/// Counts references, in tasks where they are many.
template <typename Counts>
void countInTasks(Counts& counts, std::span<const Reference> references, const Counts& none,
                  std::size_t taskSize) {
    if (references.size() < 2 * taskSize) {
        counts.count(references);
        return;
    }
    Counts others = none;
#pragma omp task default(shared)
    countInTasks(others, references.subspan(references.size() / 2), none, taskSize);
    countInTasks(counts, references.first(references.size() / 2), none, taskSize);
#pragma omp taskwait
    counts.add(others);
}

class Builder {
  public:
    Builder(std::span<const Triangle> triangles, std::span<Reference> references, BinaryTree& tree,
            double rootArea)
        : triangles_(triangles), references_(references), tree_(tree), rootArea_(rootArea) {}

    /// To be called by one thread of a parallel region.
    void build(const Task& task) {
        if (task.size() == 1) {
            const Reference& reference = references_[task.begin];
            tree_.references[task.begin] = reference.triangle();
            tree_.nodes[task.node] = {reference.box().bounds(),
                                      static_cast<std::uint32_t>(task.begin), 1};
            return;
        }
        const Children children = split(task);
        tree_.nodes[task.node] = {task.box.bounds(), children.below.node, 0};
        if (task.size() >= TASK_SIZE) {
#pragma omp task firstprivate(children)
            build(children.below);
        } else {
            build(children.below);
        }
        build(children.above);
    }

  private:
    /// Below this depth the references are halved, which takes at most 32 more levels.
    static constexpr int MOST_SAH_DEPTH = BinaryTree::MAX_DEPTH - 32;
    /// Fewer references are not worth a task.
    static constexpr std::size_t TASK_SIZE = 2048;
    /// Fewer references are not divided by several threads.
    static constexpr std::size_t MANY = 16 * TASK_SIZE;
    /// Overlap of the boxes of an object split, per area of the root, that makes a spatial split
    /// worth a try.
    static constexpr double MUCH_OVERLAP = 1e-4;

    struct Children {
        Task below;
        Task above;
    };

    std::span<Reference> referencesOf(const Task& task) const {
        return references_.subspan(task.begin, task.size());
    }

    /// Not inlined, to keep what it needs on the stack away from that of build().
    [[gnu::noinline]] Children split(const Task& task) const {
        if (task.size() == 2 || task.depth >= MOST_SAH_DEPTH)
            return halve(task);
        const float scale = task.box.scale();
        const int binCount =
            static_cast<int>(std::clamp<std::size_t>(task.size() + 1, 4, CentreCounts::MOST_BINS));
        const CentreBins bins(task.halfCentres, binCount);
        const ObjectSplit object = bestOf<CentreCounts>(task, CentreCounts(bins)).bestSplit(scale);
        if (object.overlap > MUCH_OVERLAP * rootArea_ && task.end < task.room) {
            const Slabs slabs(task.box);
            const SpatialSplit spatial = bestOf<SlabCounts>(task, SlabCounts(slabs, triangles_))
                                             .bestSplit(scale, task.room - task.begin);
            if (spatial.cost < object.cost)
                return divide(task, slabs, spatial);
        }
        return object.cost < INFINITE ? divide(task, bins, object) : halve(task);
    }

    template <typename Counts>
    Counts bestOf(const Task& task, const Counts& none) const {
        Counts counts = none;
        if (task.size() < MANY)
            counts.count(referencesOf(task));
        else
            countInTasks(counts, referencesOf(task), none, TASK_SIZE);
        return counts;
    }

    Children divide(const Task& task, const CentreBins& bins, const ObjectSplit& split) const {
        const auto sideOf = [&](const Reference& reference) {
            return bins.of(reference)[split.axis] < split.bin ? Side::BELOW : Side::ABOVE;
        };
        const auto cutOf = [](const Reference& reference) { return Parts{reference, reference}; };
        return divide(task, sideOf, cutOf, false);
    }

    Children divide(const Task& task, const Slabs& slabs, const SpatialSplit& split) const {
        const Plane plane = slabs.plane(split.axis, split.slab);
        const auto sideOf = [&](const Reference& reference) {
            const Box box = reference.box();
            const bool isBelow = slabs.of(box.low)[split.axis] < split.slab;
            const bool isAbove = slabs.of(box.high)[split.axis] >= split.slab;
            return isBelow && isAbove ? Side::BOTH : isBelow ? Side::BELOW : Side::ABOVE;
        };
        const auto cutOf = [&](const Reference& reference) {
            return cut(reference, triangles_[reference.triangle()], plane);
        };
        return divide(task, sideOf, cutOf, true);
    }

    template <typename SideOf, typename CutOf>
    Children divide(const Task& task, const SideOf& sideOf, const CutOf& cutOf, bool mayCut) const {
        Reference* const tail = references_.data() + task.end;
        return share(task, task.size() < MANY
                               ? partition(referencesOf(task), tail, sideOf, cutOf)
                               : partitionInTasks(referencesOf(task), tail, sideOf, cutOf, mayCut));
    }

    Children halve(const Task& task) const {
        Partition parts;
        for (std::size_t i = task.begin; i < task.end; ++i)
            (i - task.begin < task.size() / 2 ? parts.below : parts.above).add(references_[i]);
        return share(task, parts);
    }

    /// Shares the room of a node among its children, by their size.
    Children share(const Task& task, const Partition& parts) const {
        const auto [below, above] = parts;
        const std::size_t middle = task.begin + below.size;
        const std::size_t end = middle + above.size;
        const auto shareBelow =
            static_cast<double>(below.size) / static_cast<double>(below.size + above.size);
        const auto spareBelow =
            static_cast<std::size_t>(static_cast<double>(task.room - end) * shareBelow);
        const std::size_t begin = middle + spareBelow;
        const std::size_t moved = std::min(spareBelow, above.size);
        std::copy_n(references_.data() + middle, moved,
                    references_.data() + end + spareBelow - moved);

        // No two nodes have the same slot between their children.
        const auto node = static_cast<std::uint32_t>(2 * begin);
        tree_.parents[begin] = task.node;
        const int depth = task.depth + 1;
        return {
            {node, task.begin, middle, begin, below.box, below.halfCentres, depth},
            {node + 1, begin, begin + above.size, task.room, above.box, above.halfCentres, depth}};
    }

    std::span<const Triangle> triangles_;
    std::span<Reference> references_;
    BinaryTree& tree_;
    double rootArea_;
};

/// Makes references to all triangles with an area, and puts them in front.
Group refer(std::span<const Triangle> triangles, std::span<Reference> references) {
    const Pieces pieces(triangles.size());
    std::array<Group, Pieces::COUNT> groups;
#pragma omp parallel for schedule(dynamic)
    for (std::size_t piece = 0; piece < Pieces::COUNT; ++piece) {
        std::size_t next = pieces.begin(piece);
        for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i) {
            if (!hasArea(triangles[i]))
                continue;
            Box box = Box::empty();
            for (const V3f& vertex : triangles[i].vertices)
                box.extend(toFloat4(vertex));
            references[next] = Reference(box, static_cast<std::uint32_t>(i));
            groups[piece].add(references[next++]);
        }
    }
    Group all;
    for (std::size_t piece = 0; piece < Pieces::COUNT; ++piece) {
        if (all.size < pieces.begin(piece))
            std::copy_n(&references[pieces.begin(piece)], groups[piece].size,
                        &references[all.size]);
        all.add(groups[piece]);
    }
    return all;
}

/// Builds the tree in arrays that are large enough.
void build(BinaryTree& tree, std::span<const Triangle> triangles, std::span<Reference> references) {
    const Group all = refer(triangles, references);
    if (all.size == 0) {
        tree = {};
        return;
    }
    Builder builder(triangles, references, tree, all.box.halfArea());
#pragma omp parallel
#pragma omp single
    builder.build({0, 0, all.size, references.size(), all.box, all.halfCentres, 0});
}

}  // namespace

BinaryTree buildBinaryTree(std::span<const Triangle> triangles, double mostReferences) {
    const auto room = static_cast<std::size_t>(static_cast<double>(triangles.size()) *
                                               std::max(mostReferences, 1.0));
    if (room > std::numeric_limits<std::uint32_t>::max() / 2)
        throw std::length_error("more references to triangles than a tree can number");
    const auto references = makeKernelArrayInHugePages<Reference>(room);
    BinaryTree tree;
    tree.nodes.resize(2 * room);
    tree.parents.resize(room);
    tree.references.resize(room);
    build(tree, triangles, {references.get(), room});
    return tree;
}

}  // namespace bwfirt::wide
