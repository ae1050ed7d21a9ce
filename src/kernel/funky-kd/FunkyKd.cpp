// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/WatertightRay.h"
#include "kernel/funky-kd/KdTree.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace bwfirt {

namespace {

class FunkyKd : public RTKernel {
  public:
    std::vector<KernelOption> kernelOptions() const override {
        return {{"leaf-size", std::to_string(leafSize_),
                 "cells with at most so many triangles are not split, from 1 to 64"}};
    }

    void kernelSetOption(std::string_view, const std::string& value) override {
        const char* const end = value.data() + value.size();
        std::uint32_t size = 0;
        const auto [stop, error] = std::from_chars(value.data(), end, size);
        if (error != std::errc() || stop != end || size < 1 || size > 64)
            throw std::invalid_argument("expected a whole number from 1 to 64");
        leafSize_ = size;
    }

    void kernelInitialize(std::span<const Triangle> triangles) override {
        tree_ = buildKdTree(triangles, leafSize_);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        // What is not above half of the least float is a distance of 0 as a float.
        constexpr double T_MIN = std::numeric_limits<float>::denorm_min() / 2.0;
        double tMax = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        const WatertightRay watertightRay(V3d(ray.origin), V3d(ray.direction));
        traverse(watertightRay, tMax, [&](const Triangle4& triangles) {
            if (const auto meeting = watertightRay.intersect(triangles, T_MIN, tMax)) {
                tMax = meeting->t;
                nearest = {static_cast<float>(meeting->t), meeting->triangle};
            }
            return false;
        });
        return nearest;
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const WatertightRay segment(V3d(x), V3d(y) - V3d(x));
        bool isVisible = true;
        traverse(segment, 1, [&](const Triangle4& triangles) {
            isVisible = !segment.intersect(triangles, 0, 1);
            return !isVisible;
        });
        return isVisible;
    }

  private:
    /// The part of a ray that may lie in a cell.
    struct Interval {
        float begin;
        float end;
    };

    /// The distance to a plane carries the rounding errors of three operations. Intervals reach a
    /// little beyond their planes, so that a hit on the border of two cells is not lost.
    static constexpr float LESS = 1 - 8 * std::numeric_limits<float>::epsilon();
    static constexpr float MORE = 1 + 8 * std::numeric_limits<float>::epsilon();

    std::optional<Interval> clipToBounds(const V3f& origin, const V3f& inverse, float tMax) const {
        Interval interval{0, tMax};
        for (int axis = 0; axis < 3; ++axis) {
            const float low = tree_.bounds.low[axis], high = tree_.bounds.high[axis];
            if (std::isinf(inverse[axis])) {
                if (origin[axis] < low || origin[axis] > high)
                    return std::nullopt;
                continue;
            }
            const float tLow = (low - origin[axis]) * inverse[axis];
            const float tHigh = (high - origin[axis]) * inverse[axis];
            interval.begin = std::max(interval.begin, std::min(tLow, tHigh) * LESS);
            interval.end = std::min(interval.end, std::max(tLow, tHigh) * MORE);
        }
        if (interval.begin > interval.end)
            return std::nullopt;
        return interval;
    }

    /// Calls visit(triangles) for the triangles in the cells along the ray up to tMax, until it
    /// returns true. visit may lower tMax; a hit may lie beyond the cell in which it is found.
    template <typename Visit>
    void traverse(const WatertightRay& ray, const double& tMax, const Visit& visit) const {
        struct Entry {
            std::uint32_t node;
            Interval interval;
        };
        if (tree_.nodes.empty() || !isFinite(ray.origin()) || !isFinite(ray.direction()))
            return;
        const V3f origin(ray.origin());
        const V3f inverse(V3d(1) / ray.direction());
        const std::optional<Interval> whole =
            clipToBounds(origin, inverse, static_cast<float>(tMax));
        if (!whole)
            return;

        std::array<Entry, KdTree::MAX_DEPTH + 1> stack;  // with room for one that is not kept
        std::size_t size = 0;
        std::uint32_t index = 0;
        Interval interval = *whole;
        while (true) {
            KdNode node = tree_.nodes[index];
            while (!node.isLeaf()) {
                // Its sibling is the next in memory, but this one is far away, and often needed.
                __builtin_prefetch(&tree_.nodes[node.secondChild()]);
                const int axis = node.axis();
                const float t = (node.position() - origin[axis]) * inverse[axis];
                const bool isFirstNear = inverse[axis] > 0;
                const std::uint32_t near = isFirstNear ? index + 1 : node.secondChild();
                const std::uint32_t far = isFirstNear ? node.secondChild() : index + 1;
                // Which of the three cases it is cannot be predicted, and most of this becomes
                // conditional moves. A ray within the plane, where t is NaN, keeps its interval in
                // both cells.
                const bool isFarOnly = t < interval.begin;
                const bool isNearOnly = t > interval.end;
                stack[size] = {far, {std::max(interval.begin, t * LESS), interval.end}};
                size += isFarOnly || isNearOnly ? 0 : 1;
                interval.end = isFarOnly ? interval.end : std::min(interval.end, t * MORE);
                index = isFarOnly ? far : near;
                node = tree_.nodes[index];
            }
            for (std::uint32_t i = node.first(); i < node.first() + node.count(); ++i)
                if (visit(tree_.triangles[i]))
                    return;
            if (size == 0 || tMax < stack[size - 1].interval.begin)
                return;
            index = stack[--size].node;
            interval = stack[size].interval;
        }
    }

    std::uint32_t leafSize_ = 12;
    KdTree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<FunkyKd>();
}

}  // namespace bwfirt
