// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"
#include "kernel/bih/Tree.h"

namespace bwfirt {

namespace {

/// A distance to a plane carries the rounding errors of three operations in single precision: Ize:
/// "Robust BVH ray traversal", JCGT 2(2), 2013. Ends are moved away by more than that, at the
/// beginning and at the end of an interval together.
constexpr float MORE = 1 + 4 * std::numeric_limits<float>::epsilon();

/// The part of a ray that may lie in a node.
struct Interval {
    float begin;
    float end;
};

/// A ray prepared to meet planes across the axes.
class AxesRay {
  public:
    /// @param length of the direction; distances are in units of the scene
    AxesRay(const V3d& origin, const V3d& direction, double length) {
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            const double inverse = length / direction[i];
            origin_[axis] = static_cast<float>(origin[i]);
            isDown_[axis] = std::signbit(inverse);
            endInverse_[axis] = static_cast<float>(inverse) * MORE;
            // Where the inverse is too large for a float, the largest one puts the beginning too
            // near, and infinity the end too far.
            constexpr float LARGEST = std::numeric_limits<float>::max();
            beginInverse_[axis] =
                std::isinf(inverse)
                    ? endInverse_[axis]
                    : static_cast<float>(std::clamp<double>(inverse, -LARGEST, LARGEST));
        }
    }

    bool isDown(std::size_t axis) const { return isDown_[axis]; }

    /// The parts of the interval on this side of the plane and beyond it, with what rounding may
    /// have moved. A ray within the plane, for which the distance is NaN, keeps its interval.
    float endAt(float plane, std::size_t axis, float end) const {
        return std::min(end, (plane - origin_[axis]) * endInverse_[axis]);
    }
    float beginAt(float plane, std::size_t axis, float begin) const {
        return std::max(begin, (plane - origin_[axis]) * beginInverse_[axis]);
    }

  private:
    std::array<float, 3> origin_, beginInverse_, endInverse_;
    std::array<bool, 3> isDown_;
};

class Bih : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        triangles_ = triangles;
        tree_ = buildTree(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const WatertightRay watertightRay(V3d(ray.origin), V3d(ray.direction));
        double tMax = std::numeric_limits<float>::max();
        float reach = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        traverse(watertightRay, 1, reach, [&](std::uint32_t triangle) {
            const std::optional<double> t = watertightRay.intersect(triangles_[triangle]);
            if (t && *t<tMax&& static_cast<float>(*t)> 0) {
                tMax = *t;
                nearest = {static_cast<float>(*t), triangle};
                reach = nearest->distance * MORE;
            }
            return false;
        });
        return nearest;
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const WatertightRay segment(V3d(x), V3d(y) - V3d(x));
        const double length = segment.direction().length();
        bool isVisible = true;
        traverse(segment, length, static_cast<float>(length) * MORE, [&](std::uint32_t triangle) {
            const std::optional<double> t = segment.intersect(triangles_[triangle]);
            isVisible = !(t && *t < 1);
            return !isVisible;
        });
        return isVisible;
    }

  private:
    struct Entry {
        Node node;
        Interval interval;
    };

    /// Calls visit(triangle) for the triangles in the leaves along the ray, the nearer ones first,
    /// until it returns true. visit may shorten the reach.
    template <typename Visit>
    void traverse(const WatertightRay& ray, double length, const float& reach,
                  const Visit& visit) const {
        if (!isFinite(ray.origin()) || !isFinite(ray.direction()))
            return;
        const AxesRay axesRay(ray.origin(), ray.direction(), length);
        Interval interval{0, reach};
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            const bool isDown = axesRay.isDown(axis);
            const float low = tree_.bounds.low[i], high = tree_.bounds.high[i];
            interval.begin = axesRay.beginAt(isDown ? high : low, axis, interval.begin);
            interval.end = axesRay.endAt(isDown ? low : high, axis, interval.end);
        }
        if (interval.begin > interval.end)
            return;

        std::array<Entry, 2 * Tree::MAX_SPLITS + 1> stack;  // with room for one that is not kept
        std::size_t size = 0;
        Node node = tree_.root;
        while (true) {
            while (!node.isLeaf()) {
                const auto& children = tree_.children[node.children()];
                const std::size_t axis = node.axis();
                const bool isDown = axesRay.isDown(axis);
                const float nearEnd = isDown ? node.secondLow() : node.firstHigh();
                const float farBegin = isDown ? node.firstHigh() : node.secondLow();
                const Interval near{interval.begin, axesRay.endAt(nearEnd, axis, interval.end)};
                const Interval far{axesRay.beginAt(farBegin, axis, interval.begin), interval.end};
                const bool isNearMet = near.begin <= near.end;
                const bool isFarMet = far.begin <= far.end;
                if (!isNearMet && !isFarMet)
                    break;
                // Which of the cases it is cannot be predicted, and most of this becomes
                // conditional moves.
                stack[size] = {children[isDown ? 0 : 1], far};
                size += isNearMet && isFarMet ? 1 : 0;
                node = children[isNearMet == isDown ? 1 : 0];
                interval = isNearMet ? near : far;
            }
            if (node.isLeaf())
                for (std::uint32_t i = node.first(); i < node.first() + node.count(); ++i)
                    if (visit(tree_.order[i]))
                        return;
            do {
                if (size == 0)
                    return;
                node = stack[--size].node;
                interval = stack[size].interval;
                interval.end = std::min(interval.end, reach);
            } while (interval.begin > interval.end);
        }
    }

    std::span<const Triangle> triangles_;
    Tree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<Bih>();
}

}  // namespace bwfirt
