// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/WatertightRay.h"
#include "kernel/qbvh/BoxRay.h"
#include "kernel/qbvh/LeafRay.h"
#include "kernel/qbvh/Tree.h"

#include <array>
#include <bit>

namespace bwfirt {

namespace {

/// A child of a node that a ray meets.
struct Entry {
    const Node* node;
    std::uint32_t child;
    std::int32_t enter;  ///< bits of the distance
};

/// A node on the way down leaves all of its children but one on the stack. What is written to it
/// may reach a node's children farther.
constexpr std::size_t STACK_SIZE = Tree::MAX_DEPTH * (Node::WIDTH - 1) + Node::WIDTH;

class Qbvh : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle> triangles) override {
        triangles_ = triangles;
        tree_ = buildTree(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const V3d origin(ray.origin), direction(ray.direction);
        if (!isAsked(origin, direction))
            return std::nullopt;
        const TreeRay treeRay(origin, direction, tree_.scale);
        const BoxRay boxRay(treeRay);
        const LeafRay leafRay(treeRay);
        const WatertightRay exactRay(origin, direction);
        double tNearest = std::numeric_limits<float>::max();
        std::optional<Hit> nearest;
        float tMax = treeRay.distance(tNearest);
        std::int32_t lastToEnter = lastEnter(tMax);

        std::array<Entry, STACK_SIZE> stack;
        std::size_t size = 0;
        Entry current{tree_.nodes.get(), 0, 0};
        const auto pop = [&] {
            do {
                if (size == 0)
                    return false;
                current = stack[--size];
            } while (current.enter > lastToEnter);
            if (size > 0)
                prefetch(stack[size - 1]);
            return true;
        };
        while (true) {
            const BoxRay::Meeting meeting = boxRay.meet(*current.node, tMax);
            if (meeting.children != 0)
                current.child = pushAllButNearest(*current.node, meeting, stack.data(), size);
            else if (!pop())
                return nearest;
            while (current.node->isLeaf(current.child)) {
                const Leaf leaf(tree_.leaves.get(), current.node->leaf(current.child));
                const LeafGrid grid(*current.node, current.child);
                unsigned possible = leafRay.meet(grid, leaf, tMax).possible;
                for (; possible != 0; possible &= possible - 1) {
                    const std::uint32_t triangle =
                        leaf.triangle(static_cast<std::size_t>(std::countr_zero(possible)));
                    const auto t = exactRay.intersect(triangles_[triangle]);
                    // At equal distance the lowest index wins, whatever the tree looks like.
                    const bool isNearer = t && (*t < tNearest || (nearest && *t == tNearest &&
                                                                  triangle < nearest->triangle));
                    if (isNearer && static_cast<float>(*t) > 0) {
                        tNearest = *t;
                        nearest = {static_cast<float>(*t), triangle};
                        tMax = treeRay.distance(tNearest);
                        lastToEnter = lastEnter(tMax);
                    }
                }
                if (!pop())
                    return nearest;
            }
            current.node = &tree_.nodes[current.node->children[current.child]];
        }
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const V3d origin(x), direction = V3d(y) - origin;
        if (!isAsked(origin, direction))
            return true;
        const TreeRay treeRay(origin, direction, tree_.scale);
        if (treeRay.misses)
            return true;
        const BoxRay boxRay(treeRay);
        const LeafRay leafRay(treeRay);
        const WatertightRay exactRay(origin, direction);
        const float tMax = treeRay.distance(1);

        // Children of nodes, by their number among all children of all nodes.
        std::array<std::uint32_t, (NODES_AT_A_TIME + 1) * Node::WIDTH> leaves;
        std::array<std::uint32_t, STACK_SIZE * NODES_AT_A_TIME> nodes;
        std::size_t leafCount = 0, nodeCount = 0;
        const auto push = [&](std::uint32_t index, unsigned children) {
            const Node& node = tree_.nodes[index];
            const unsigned inner = children & ~node.leaves();
            storeChosen(&nodes[nodeCount], inner, node.allChildren());
            nodeCount += static_cast<std::size_t>(std::popcount(inner));
            const unsigned outer = children & node.leaves();
            storeChosen(&leaves[leafCount], outer,
                        static_cast<std::int32_t>(index * Node::WIDTH) + Int4{0, 1, 2, 3});
            leafCount += static_cast<std::size_t>(std::popcount(outer));
        };
        nodes[nodeCount++] = 0;
        while (nodeCount > 0) {
            const std::uint32_t one = nodes[--nodeCount];
            const bool areTwo = nodeCount > 0;
            const std::uint32_t two = areTwo ? nodes[--nodeCount] : one;
            const unsigned ofOne = boxRay.meet(tree_.nodes[one], tMax).children;
            const unsigned ofTwo = areTwo ? boxRay.meet(tree_.nodes[two], tMax).children : 0;
            push(two, ofTwo);
            push(one, ofOne);
            while (leafCount > 0) {
                const std::uint32_t number = leaves[--leafCount];
                const Node& node = tree_.nodes[number / Node::WIDTH];
                const std::size_t child = number % Node::WIDTH;
                const Leaf leaf(tree_.leaves.get(), node.leaf(child));
                const LeafRay::Meeting meeting = leafRay.meet(LeafGrid(node, child), leaf, tMax);
                if (meeting.certain != 0 ||
                    (meeting.possible != 0 && isBlocked(exactRay, leaf, meeting.possible)))
                    return false;
            }
        }
        return true;
    }

  private:
    static constexpr std::size_t NODES_AT_A_TIME = 2;

    bool isAsked(const V3d& origin, const V3d& direction) const {
        return tree_.nodes && isFinite(origin) && isFinite(direction) && direction != V3d(0);
    }

    /// The largest bits of a distance at which a box may be entered.
    static std::int32_t lastEnter(float tMax) {
        return (std::bit_cast<std::int32_t>(tMax) + BoxRay::SLACK) | LANE_BITS;
    }

    static constexpr std::int32_t LANE_BITS = 3;

    /// Pushes the children that the ray meets, the nearer ones last, but for the nearest, which it
    /// returns. Their number can be predicted now and then; their order cannot, and no branch
    /// depends on it.
    [[gnu::always_inline]] static std::uint32_t pushAllButNearest(const Node& node,
                                                                  const BoxRay::Meeting& meeting,
                                                                  Entry* stack, std::size_t& size) {
        const auto first = static_cast<std::uint32_t>(std::countr_zero(meeting.children));
        unsigned rest = meeting.children & (meeting.children - 1);
        if (rest == 0)
            return first;
        const auto second = static_cast<std::uint32_t>(std::countr_zero(rest));
        rest &= rest - 1;
        if (rest == 0) {
            const std::int32_t enterFirst = meeting.enter[static_cast<int>(first)];
            const std::int32_t enterSecond = meeting.enter[static_cast<int>(second)];
            const bool isFirstNearer = enterFirst <= enterSecond;
            stack[size++] = {&node, isFirstNearer ? second : first,
                             isFirstNearer ? enterSecond : enterFirst};
            return isFirstNearer ? first : second;
        }
        // A network of exchanges sorts the distances, in whose last bits are their lanes.
        const Int4 lanes{0, 1, 2, 3};
        const Int4 areMet = ((static_cast<std::int32_t>(meeting.children) >> lanes) & 1) != 0;
        Int4 keys =
            areMet ? (meeting.enter & ~LANE_BITS) | lanes : Int4{NO_KEY, NO_KEY, NO_KEY, NO_KEY};
        const auto exchange = [&](const Int4& others, const Int4& takesLarger) {
            keys = takesLarger ? greater(keys, others) : lesser(keys, others);
        };
        exchange(__builtin_shufflevector(keys, keys, 1, 0, 3, 2), Int4{0, -1, 0, -1});
        exchange(__builtin_shufflevector(keys, keys, 2, 3, 0, 1), Int4{0, 0, -1, -1});
        exchange(__builtin_shufflevector(keys, keys, 0, 2, 1, 3), Int4{0, 0, -1, 0});
        const auto entry = [&](int i) {
            return Entry{&node, static_cast<std::uint32_t>(keys[i] & LANE_BITS), keys[i]};
        };
        stack[size] = entry(3);
        size += keys[3] != NO_KEY ? 1 : 0;
        stack[size++] = entry(2);
        stack[size++] = entry(1);
        return static_cast<std::uint32_t>(keys[0] & LANE_BITS);
    }

    static constexpr std::int32_t NO_KEY = std::numeric_limits<std::int32_t>::max();

    /// Of triangles that the segment may meet.
    [[gnu::noinline]] bool isBlocked(const WatertightRay& ray, const Leaf& leaf,
                                     unsigned possible) const {
        for (; possible != 0; possible &= possible - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(possible));
            const std::optional<double> t = ray.intersect(triangles_[leaf.triangle(i)]);
            if (t && *t < 1)
                return true;
        }
        return false;
    }

    void prefetch(const Entry& entry) const {
        if (entry.node->isLeaf(entry.child))
            Leaf(tree_.leaves.get(), entry.node->leaf(entry.child)).prefetch();
        else
            __builtin_prefetch(&tree_.nodes[entry.node->children[entry.child]]);
    }

    std::span<const Triangle> triangles_;
    Tree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<Qbvh>();
}

}  // namespace bwfirt
