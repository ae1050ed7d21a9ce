// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"
#include "kernel/simple-bvh/Box.h"

#include <algorithm>
#include <array>

namespace bwfirt {

namespace {

class SimpleBvh : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        triangles_ = triangles;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            if (hasArea(triangles[i]))
                order_.push_back(i);
        if (!order_.empty())
            build(0, static_cast<std::uint32_t>(order_.size()), 0);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const WatertightRay watertightRay(V3d(ray.origin), V3d(ray.direction));
        double tNearest = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        traverse(watertightRay, tNearest, [&](std::uint32_t triangle, double t) {
            const auto distance = static_cast<float>(t);
            // At equal distance the lowest index wins, so that the answer depends on the scene
            // alone and not on the order in which the tree is walked.
            const bool isNearer =
                t < tNearest || (nearest && t == tNearest && triangle < nearest->triangle);
            if (isNearer && distance > 0) {
                tNearest = t;
                nearest = {distance, triangle};
            }
            return false;
        });
        return nearest;
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const WatertightRay segment(V3d(x), V3d(y) - V3d(x));
        double tMax = 1;
        bool isVisible = true;
        traverse(segment, tMax, [&](std::uint32_t, double t) {
            if (t < 1)
                isVisible = false;
            return !isVisible;
        });
        return isVisible;
    }

  private:
    struct Node {
        Box box;
        std::uint32_t first;  ///< leaf: its first entry in order_; inner node: its second child
        std::uint32_t count;  ///< leaf: number of triangles; inner node: 0
    };

    static constexpr std::uint32_t LEAF_SIZE = 4;
    /// Below this depth the triangles are halved, which takes at most 32 more levels.
    static constexpr int MAX_MIDDLE_DEPTH = 64;
    /// A node on the way down leaves one of its children on the stack.
    static constexpr std::size_t STACK_SIZE = MAX_MIDDLE_DEPTH + 32 + 1;

    /// Appends the tree over order_[begin, end): its root, then the first child's tree, then the
    /// second child's.
    void build(std::uint32_t begin, std::uint32_t end, int depth) {
        const std::size_t index = nodes_.size();
        nodes_.push_back({boxOf(begin, end), begin, end - begin});
        if (end - begin <= LEAF_SIZE)
            return;

        const std::uint32_t middle =
            depth < MAX_MIDDLE_DEPTH ? splitAtMiddle(begin, end) : begin + (end - begin) / 2;
        build(begin, middle, depth + 1);
        nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
        nodes_[index].count = 0;
        build(middle, end, depth + 1);
    }

    /// Partitions order_[begin, end) in two and returns where the second part begins: at the middle
    /// of the centroids along their longest axis, or in halves where all are on one side of it.
    std::uint32_t splitAtMiddle(std::uint32_t begin, std::uint32_t end) {
        const auto centroid = [&](std::uint32_t triangle) {
            const auto& v = triangles_[triangle].vertices;
            return (V3d(v[0]) + V3d(v[1]) + V3d(v[2])) / 3;
        };
        Box box;
        for (std::uint32_t i = begin; i < end; ++i)
            box.extend(centroid(order_[i]));
        const V3d size = box.high - box.low;
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        const double middle = box.low[axis] + size[axis] / 2;
        const auto second =
            std::partition(order_.begin() + begin, order_.begin() + end,
                           [&](std::uint32_t i) { return centroid(i)[axis] < middle; });
        const auto position = static_cast<std::uint32_t>(second - order_.begin());
        return position == begin || position == end ? begin + (end - begin) / 2 : position;
    }

    Box boxOf(std::uint32_t begin, std::uint32_t end) const {
        Box box;
        for (std::uint32_t i = begin; i < end; ++i)
            for (const V3f& vertex : triangles_[order_[i]].vertices)
                box.extend(V3d(vertex));
        box.pad();
        return box;
    }

    /// Calls onHit(triangle, t) for each triangle that the ray meets in a box entered before tMax,
    /// nearer boxes first, until it returns true. onHit may lower tMax.
    template <typename OnHit>
    void traverse(const WatertightRay& ray, double& tMax, const OnHit& onHit) const {
        struct Entry {
            std::uint32_t node;
            double t;
        };
        if (nodes_.empty() || !isFinite(ray.origin()) || !isFinite(ray.direction()))
            return;
        const BoxRay boxRay{ray.origin(), ray.direction()};
        const auto enter = [&](std::uint32_t node) { return nodes_[node].box.enter(boxRay, tMax); };
        std::array<Entry, STACK_SIZE> stack;
        std::size_t size = 0;
        if (const auto t = enter(0))
            stack[size++] = {0, *t};

        while (size > 0) {
            const Entry entry = stack[--size];
            if (entry.t > tMax)
                continue;
            const Node& node = nodes_[entry.node];
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                if (const auto t = ray.intersect(triangles_[order_[i]]))
                    if (onHit(order_[i], *t))
                        return;
            if (node.count > 0)
                continue;

            const std::uint32_t one = entry.node + 1, other = node.first;
            const auto tOne = enter(one);
            const auto tOther = enter(other);
            const bool isOneNearer = tOne && (!tOther || *tOne < *tOther);
            if (isOneNearer && tOther)
                stack[size++] = {other, *tOther};
            if (tOne)
                stack[size++] = {one, *tOne};
            if (!isOneNearer && tOther)
                stack[size++] = {other, *tOther};
        }
    }

    std::span<const Triangle> triangles_;
    KernelVector<std::uint32_t> order_;  ///< triangles in the order of the leaves
    KernelVector<Node> nodes_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<SimpleBvh>();
}

}  // namespace bwfirt
