// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/Box.h"
#include "kernel/Triangle4.h"

#include <array>
#include <cstdint>

namespace bwfirt {

struct Node;

/// A leaf, which is up to four triangles, or a node. The address of either is even; the lowest bit
/// tells them apart.
class Child {
  public:
    Child() = default;
    explicit Child(const Node* node) : bits_(reinterpret_cast<std::uintptr_t>(node)) {}
    explicit Child(const Triangle4* leaf) : bits_(reinterpret_cast<std::uintptr_t>(leaf) | 1) {}

    bool isLeaf() const { return bits_ & 1; }
    const Node* node() const { return reinterpret_cast<const Node*>(bits_); }
    const Triangle4* leaf() const { return reinterpret_cast<const Triangle4*>(bits_ - 1); }
    const char* address() const { return reinterpret_cast<const char*>(bits_); }

  private:
    std::uintptr_t bits_;
};

/// A node with up to eight children. Their boxes stand side by side, one plane of all eight after
/// the other, so that a loop over the children becomes instructions on eight numbers.
struct alignas(64) Node {
    static constexpr std::size_t WIDTH = 8;
    using Plane = std::array<float, WIDTH>;

    std::array<Plane, 6> planes;  ///< low x, y, z and high x, y, z; an empty box for no child
    std::array<Child, WIDTH> children;

    Node() {
        for (std::size_t i = 0; i < WIDTH; ++i)
            setBox(i, Box());
    }

    void setBox(std::size_t child, const Box& box) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            planes[i][child] = box.low[axis];
            planes[3 + i][child] = box.high[axis];
        }
    }
};
static_assert(sizeof(Node) == 256, "four lines of the cache");

}  // namespace bwfirt
