// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"
#include "kernel/qbvh/BoxRay.h"
#include "kernel/qbvh/Tree.h"
#include "kernel/qbvh/TriangleFilter.h"

#include <array>

namespace bwfirt {

namespace {

/// Something to visit, and where the ray enters its box.
struct Entry {
    Child child;
    float enter;
};

class Qbvh : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        triangles_ = triangles;
        tree_ = buildTree(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const V3d origin(ray.origin), direction(ray.direction);
        double tNearest = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        traverse<true>(origin, direction, tNearest, [&](std::uint32_t triangle, double t) {
            const auto distance = static_cast<float>(t);
            // At equal distance the lowest index wins, whatever the tree looks like.
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
        double tMax = 1;
        bool isVisible = true;
        traverse<false>(V3d(x), V3d(y) - V3d(x), tMax, [&](std::uint32_t, double t) {
            isVisible = !(t < 1);
            return !isVisible;
        });
        return isVisible;
    }

  private:
    /// A node on the way down leaves all of its children but one on the stack.
    static constexpr std::size_t STACK_SIZE = Tree::MAX_DEPTH * (Node::WIDTH - 1) + Node::WIDTH;

    /// Calls onHit(triangle, t) for each triangle that the ray meets in a box entered before tMax,
    /// nearer boxes first, until it returns true. onHit may lower tMax.
    template <bool IS_ORDERED, typename OnHit>
    void traverse(const V3d& origin, const V3d& direction, double& tMax, const OnHit& onHit) const {
        if (!tree_.nodes || !isFinite(origin) || !isFinite(direction) || direction == V3d(0))
            return;
        const WatertightRay ray(origin, direction);
        const TriangleFilter filter(origin, direction);
        const BoxRay boxRay(origin, direction, tree_.scale);
        float tMaxInTree = boxRay.toTree(tMax);
        float depth = filter.depth(tMax);

        std::array<Entry, STACK_SIZE> stack;
        std::size_t size = 0;
        stack[size++] = {Child::node(0), 0};
        while (size > 0) {
            --size;
            if (stack[size].enter > tMaxInTree)
                continue;
            const Child child = stack[size].child;
            if (size > 0)
                prefetch(stack[size - 1].child);
            if (!child.isLeaf()) {
                const Node& node = tree_.nodes[child.nodeIndex()];
                const BoxRay::Intervals intervals = boxRay.intersect(node, tMaxInTree);
                if constexpr (IS_ORDERED)
                    size += pushNearestLast(node, intervals, &stack[size]);
                else
                    size += push(node, intervals, &stack[size]);
                continue;
            }
            const std::span indices(&tree_.indices[child.first()], child.count());
            const auto mayMeet = filter.mayMeet(triangles_, indices, depth);
            if (none_of(mayMeet))
                continue;
            for (std::size_t i = 0; i < indices.size(); ++i) {
                if (!mayMeet[i])
                    continue;
                if (const auto t = ray.intersect(triangles_[indices[i]]))
                    if (onHit(indices[i], *t))
                        return;
            }
            tMaxInTree = boxRay.toTree(tMax);
            depth = filter.depth(tMax);
        }
    }

    /// Writes the children that the ray meets to `top`, the nearest last, and returns how many they
    /// are. Their number can be predicted now and then; their order cannot, and no branch depends
    /// on it.
    [[gnu::always_inline]] static std::size_t pushNearestLast(const Node& node,
                                                              const BoxRay::Intervals& intervals,
                                                              Entry* top) {
        const auto areMet = intervals.areMet();
        const auto count = static_cast<std::size_t>(popcount(areMet));
        if (count == 0)
            return 0;
        std::array<float, Node::WIDTH> enter;
        intervals.enter.copy_to(enter.data(), std::experimental::element_aligned);
        const auto entry = [&](std::size_t i) { return Entry{node.children[i], enter[i]}; };
        const auto first = static_cast<std::size_t>(find_first_set(areMet));
        if (count == 1) {
            top[0] = entry(first);
            return count;
        }
        if (count == 2) {
            const auto last = static_cast<std::size_t>(find_last_set(areMet));
            const std::size_t nearer = enter[first] < enter[last] ? 1 : 0;
            top[nearer] = entry(first);
            top[1 - nearer] = entry(last);
            return count;
        }
        for (std::size_t i = 0; i < Node::WIDTH; ++i)
            enter[i] = areMet[i] ? enter[i] : -1;
        std::array<std::size_t, Node::WIDTH> fartherOnes{};
        for (std::size_t i = 1; i < Node::WIDTH; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const std::size_t isFarther = enter[j] < enter[i] ? 1 : 0;
                fartherOnes[j] += isFarther;
                fartherOnes[i] += 1 - isFarther;
            }
        }
        for (std::size_t i = 0; i < Node::WIDTH; ++i)
            top[fartherOnes[i]] = entry(i);
        return count;
    }

    /// Writes the children that the ray meets to `top` as they stand.
    [[gnu::always_inline]] static std::size_t push(const Node& node,
                                                   const BoxRay::Intervals& intervals, Entry* top) {
        const auto areMet = intervals.areMet();
        std::size_t count = 0;
        for (std::size_t i = 0; i < Node::WIDTH; ++i) {
            top[count] = {node.children[i], 0};
            count += areMet[i] ? 1 : 0;
        }
        return count;
    }

    void prefetch(Child child) const {
        if (child.isLeaf())
            __builtin_prefetch(&tree_.indices[child.first()]);
        else
            __builtin_prefetch(&tree_.nodes[child.nodeIndex()]);
    }

    std::span<const Triangle> triangles_;
    Tree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<Qbvh>();
}

}  // namespace bwfirt
