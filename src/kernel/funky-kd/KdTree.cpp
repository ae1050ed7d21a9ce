// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/funky-kd/KdTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bwfirt {

namespace {

/// A triangle in a cell: its box, cut off where the cell ends.
struct Reference {
    Bounds bounds;
    std::uint32_t triangle;
};

struct Split {
    int axis;
    float position;
};

constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// The neighbouring floats in the direction of `target`: room for rounding errors.
V3f stepTo(const V3f& point, float target) {
    return {std::nextafter(point.x, target), std::nextafter(point.y, target),
            std::nextafter(point.z, target)};
}

Bounds emptyBounds() {
    return {V3f(INFINITE), V3f(-INFINITE)};
}

void extend(Bounds& bounds, const Bounds& other) {
    for (int axis = 0; axis < 3; ++axis) {
        bounds.low[axis] = std::min(bounds.low[axis], other.low[axis]);
        bounds.high[axis] = std::max(bounds.high[axis], other.high[axis]);
    }
}

Bounds boundsOf(const Triangle& triangle) {
    Bounds bounds = emptyBounds();
    for (const V3f& vertex : triangle.vertices)
        extend(bounds, {vertex, vertex});
    return bounds;
}

class Builder {
  public:
    Builder(KdTree& tree, std::span<const Triangle> triangles, std::uint32_t leafSize)
        : tree_(tree), triangles_(triangles), leafSize_(leafSize) {}

    void build(const Bounds& cell, KernelVector<Reference> references, int depthLeft) {
        const std::optional<Split> split = references.size() > leafSize_ && depthLeft > 0
                                               ? chooseSplit(cell, references)
                                               : std::nullopt;
        if (!split)
            return appendLeaf(references);

        const auto [axis, position] = *split;
        KernelVector<Reference> first, second;
        for (const Reference& reference : references) {
            const bool isInSecond = reference.bounds.high[axis] > position;
            const bool isInFirst = reference.bounds.low[axis] < position || !isInSecond;
            if (isInFirst && isInSecond) {
                first.push_back(cut(reference, *split, true));
                second.push_back(cut(reference, *split, false));
            } else {
                (isInFirst ? first : second).push_back(reference);
            }
        }
        references = {};

        const std::size_t index = tree_.nodes.size();
        if (index >= KdNode::MOST_NODES)
            throw std::length_error("the kd-tree has more nodes than it can number");
        tree_.nodes.push_back(KdNode::inner(axis, position));
        Bounds firstCell = cell, secondCell = cell;
        firstCell.high[axis] = secondCell.low[axis] = position;
        build(firstCell, std::move(first), depthLeft - 1);
        tree_.nodes[index].setSecondChild(static_cast<std::uint32_t>(tree_.nodes.size()));
        build(secondCell, std::move(second), depthLeft - 1);
    }

  private:
    /// A share of a cell's length that is worth a node of its own when it is empty.
    static constexpr double MUCH_EMPTY_SPACE = 0.1;
    /// A split must not leave more references than this in the two parts together, per reference.
    static constexpr double MOST_DUPLICATION = 1.4;

    /// What remains of a reference on one side of a plane: the box of that part of the triangle,
    /// within the box that it had.
    Reference cut(const Reference& reference, const Split& split, bool isFirst) const {
        const auto [axis, position] = split;
        Bounds part = emptyBounds();
        const auto& vertices = triangles_[reference.triangle].vertices;
        for (int i = 0; i < 3; ++i) {
            const V3f& a = vertices[static_cast<std::size_t>(i)];
            const V3f& b = vertices[static_cast<std::size_t>((i + 1) % 3)];
            if (isFirst ? a[axis] <= position : a[axis] >= position)
                extend(part, {a, a});
            if ((a[axis] < position) != (b[axis] < position)) {
                const double s = (static_cast<double>(position) - a[axis]) /
                                 (static_cast<double>(b[axis]) - a[axis]);
                const V3f point((1 - s) * V3d(a) + s * V3d(b));
                extend(part, {stepTo(point, -INFINITE), stepTo(point, INFINITE)});
            }
        }
        Reference result = reference;
        for (int i = 0; i < 3; ++i) {
            result.bounds.low[i] = std::max(part.low[i], reference.bounds.low[i]);
            result.bounds.high[i] = std::min(part.high[i], reference.bounds.high[i]);
        }
        if (isFirst)
            result.bounds.high[axis] = std::min(result.bounds.high[axis], position);
        else
            result.bounds.low[axis] = std::max(result.bounds.low[axis], position);
        return result;
    }

    void appendLeaf(const KernelVector<Reference>& references) {
        const std::size_t first = tree_.triangles.size();
        for (std::size_t i = 0; i < references.size(); i += Triangle4::SIZE) {
            std::array<std::uint32_t, Triangle4::SIZE> indices;
            const std::size_t count = std::min(references.size() - i, indices.size());
            for (std::size_t k = 0; k < count; ++k)
                indices[k] = references[i + k].triangle;
            tree_.triangles.emplace_back(triangles_, std::span(indices.data(), count));
        }
        tree_.nodes.push_back(
            KdNode::leaf(static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(tree_.triangles.size() - first)));
    }

    std::optional<Split> chooseSplit(const Bounds& cell,
                                     const KernelVector<Reference>& references) const {
        Bounds content = emptyBounds();
        for (const Reference& reference : references)
            extend(content, reference.bounds);
        if (const auto split = cutOffEmptySpace(cell, content))
            return split;

        std::array<int, 3> axes = {0, 1, 2};
        const auto length = [&](int axis) {
            return static_cast<double>(content.high[axis]) - content.low[axis];
        };
        std::sort(axes.begin(), axes.end(), [&](int a, int b) { return length(a) > length(b); });
        for (const int axis : axes) {
            const auto middle = static_cast<float>(content.low[axis] + length(axis) / 2);
            if (isWorthwhile({axis, middle}, references))
                return Split{axis, middle};
        }
        return std::nullopt;
    }

    static std::optional<Split> cutOffEmptySpace(const Bounds& cell, const Bounds& content) {
        double most = MUCH_EMPTY_SPACE;
        std::optional<Split> split;
        for (int axis = 0; axis < 3; ++axis) {
            const double length = static_cast<double>(cell.high[axis]) - cell.low[axis];
            const double below = (static_cast<double>(content.low[axis]) - cell.low[axis]) / length;
            const double above =
                (static_cast<double>(cell.high[axis]) - content.high[axis]) / length;
            if (below > most) {
                most = below;
                split = Split{axis, content.low[axis]};
            }
            if (above > most) {
                most = above;
                split = Split{axis, content.high[axis]};
            }
        }
        return split;
    }

    static bool isWorthwhile(const Split& split, const KernelVector<Reference>& references) {
        std::size_t first = 0, second = 0;
        for (const Reference& reference : references) {
            const bool isInSecond = reference.bounds.high[split.axis] > split.position;
            const bool isInFirst = reference.bounds.low[split.axis] < split.position || !isInSecond;
            first += isInFirst ? 1 : 0;
            second += isInSecond ? 1 : 0;
        }
        const auto count = static_cast<double>(references.size());
        return static_cast<double>(first + second) <= MOST_DUPLICATION * count;
    }

    KdTree& tree_;
    std::span<const Triangle> triangles_;
    std::uint32_t leafSize_;
};

}  // namespace

KdTree buildKdTree(std::span<const Triangle> triangles, std::uint32_t leafSize) {
    KdTree tree;
    tree.bounds = emptyBounds();
    KernelVector<Reference> references;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!hasArea(triangles[i]))
            continue;
        references.push_back({boundsOf(triangles[i]), i});
        extend(tree.bounds, references.back().bounds);
    }
    if (references.empty())
        return tree;
    // Pharr, Jakob, Humphreys: Physically Based Rendering, section "Kd-tree accelerator".
    const int depth = static_cast<int>(8 + 1.3 * std::log2(references.size()));
    Builder(tree, triangles, leafSize).build(tree.bounds, std::move(references), depth);
    tree.nodes.shrink_to_fit();
    tree.triangles.shrink_to_fit();
    return tree;
}

}  // namespace bwfirt
