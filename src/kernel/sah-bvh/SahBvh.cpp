// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/WatertightRay.h"
#include "kernel/sah-bvh/Builder.h"

#include <bit>

namespace bwfirt {

namespace {

/// The distance to a plane carries the rounding errors of three operations in single precision:
/// Ize: "Robust BVH ray traversal", JCGT 2(2), 2013. Far planes are moved away by more than that.
constexpr float MORE = 1 + 4 * std::numeric_limits<float>::epsilon();

/// A ray prepared for tests against the boxes of a node's children.
class BoxRay {
  public:
    /// @param length of the direction; distances are in units of the scene
    BoxRay(const V3d& origin, const V3d& direction, double length) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double inverse = length / direction[axis];
            const bool isDown = std::signbit(inverse);
            nearPlane_[i] = isDown ? i + 3 : i;
            farPlane_[i] = isDown ? i : i + 3;
            origin_[i] = static_cast<float>(origin[axis]);
            nearInverse_[i] = static_cast<float>(inverse);
            // Where the inverse is too large for a float, the largest one puts the near plane too
            // near, and infinity the far plane too far.
            if (direction[axis] != 0)
                nearInverse_[i] = std::clamp(nearInverse_[i], -std::numeric_limits<float>::max(),
                                             std::numeric_limits<float>::max());
            farInverse_[i] = static_cast<float>(inverse) * MORE;
        }
    }

    /// The distances at which the ray enters the boxes of the children, 0 where it starts inside.
    /// @return a bit for each child that is entered up to tMax
    std::uint32_t enter(const Node& node, float tMax, Node::Plane& distances) const {
        std::uint32_t hits = 0;
        for (std::size_t i = 0; i < Node::WIDTH; ++i) {
            float near = 0;
            float far = tMax;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float nearPlane = node.planes[nearPlane_[axis]][i];
                const float farPlane = node.planes[farPlane_[axis]][i];
                // A ray within the plane, where this is NaN, is taken for one inside.
                near = std::max(near, (nearPlane - origin_[axis]) * nearInverse_[axis]);
                far = std::min(far, (farPlane - origin_[axis]) * farInverse_[axis]);
            }
            distances[i] = near;
            hits |= static_cast<std::uint32_t>(near <= far) << i;
        }
        return hits;
    }

  private:
    std::array<std::size_t, 3> nearPlane_, farPlane_;  ///< those of Node::planes met first, last
    std::array<float, 3> origin_;
    std::array<float, 3> nearInverse_, farInverse_;
};

class SahBvh : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        root_ = buildBvh(triangles, arena_.emplace());
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        // What is not above half of the least float is a distance of 0 as a float.
        constexpr double T_MIN = std::numeric_limits<float>::denorm_min() / 2.0;
        const WatertightRay watertightRay(V3d(ray.origin), V3d(ray.direction));
        double tMax = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        traverse<true>(watertightRay, 1, static_cast<float>(tMax),
                       [&](const Triangle4& leaf, float& reach) {
                           if (const auto meeting = watertightRay.intersect(leaf, T_MIN, tMax)) {
                               tMax = meeting->t;
                               nearest = {static_cast<float>(tMax), meeting->triangle};
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
        traverse<false>(segment, length, static_cast<float>(length) * MORE,
                        [&](const Triangle4& leaf, float&) {
                            isVisible = !segment.intersect(leaf, 0, 1);
                            return !isVisible;
                        });
        return isVisible;
    }

  private:
    struct Entry {
        Child child;
        float distance;
    };
    /// A node on the way down leaves all of its children but one on the stack.
    static constexpr std::size_t STACK_SIZE = MAX_DEPTH * (Node::WIDTH - 1) + 1;

    /// Calls visit(leaf, reach) for the leaves along the ray, until it returns true. visit may
    /// shorten the reach. Where isOrdered, the nearer of a node's children come first.
    template <bool isOrdered, typename Visit>
    void traverse(const WatertightRay& ray, double length, float reach, const Visit& visit) const {
        if (root_ == nullptr || !isFinite(ray.origin()) || !isFinite(ray.direction()))
            return;
        const BoxRay boxRay(ray.origin(), ray.direction(), length);
        std::array<Entry, STACK_SIZE> stack;
        std::size_t size = 0;
        stack[size++] = {Child(root_), 0};
        while (size > 0) {
            const auto [child, distance] = stack[--size];
            if (distance > reach)
                continue;
            if (child.isLeaf()) {
                if (visit(*child.leaf(), reach))
                    return;
                continue;
            }
            const Node& node = *child.node();
            Node::Plane distances;
            const std::size_t first = size;
            for (std::uint32_t hits = boxRay.enter(node, reach, distances); hits != 0;
                 hits &= hits - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(hits));
                __builtin_prefetch(node.children[i].address());
                stack[size++] = {node.children[i], distances[i]};
            }
            if constexpr (isOrdered)
                sortNearestLast(stack.data() + first, stack.data() + size);
        }
    }

    /// By insertion: most often there are one or two.
    static void sortNearestLast(Entry* begin, Entry* end) {
        for (Entry* next = begin + 1; next < end; ++next) {
            const Entry entry = *next;
            Entry* place = next;
            for (; place > begin && place[-1].distance < entry.distance; --place)
                *place = place[-1];
            *place = entry;
        }
    }

    std::optional<Arena> arena_;
    const Node* root_ = nullptr;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<SahBvh>();
}

}  // namespace bwfirt
