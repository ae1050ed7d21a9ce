// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/KernelArray.h"
#include "kernel/bih/Node.h"

#include <omp.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace bwfirt {

using NodePair = std::array<Node, 2>;

/// Room for the children of nodes, which several threads take at once.
class NodePairs {
  public:
    explicit NodePairs(std::size_t most)
        : blocks_(static_cast<std::size_t>(omp_get_max_threads())),
          pairs_(makeKernelArray<NodePair>(roomFor(most))) {}

    /// What has to be there for so many pairs.
    std::size_t roomFor(std::size_t most) const { return most + BLOCK * blocks_.size(); }

    NodePair& operator[](std::uint32_t place) { return pairs_[place]; }
    const NodePair& operator[](std::uint32_t place) const { return pairs_[place]; }

    /// @return the place of a pair that is not in use
    std::uint32_t take() {
        Block& block = blocks_[static_cast<std::size_t>(omp_get_thread_num())];
        if (block.next == block.end) {
            block.next = size_.fetch_add(BLOCK);
            block.end = block.next + BLOCK;
        }
        return block.next++;
    }

    /// All places that have been taken are below.
    std::size_t size() const { return size_; }

    KernelArray<NodePair> release() {
        shrink(pairs_, size_);
        return std::move(pairs_);
    }

  private:
    static constexpr std::uint32_t BLOCK = 64;

    /// Places that a thread may still use; in a cache line of its own.
    struct alignas(64) Block {
        std::uint32_t next = 0;
        std::uint32_t end = 0;
    };

    KernelVector<Block> blocks_;  ///< by thread
    KernelArray<NodePair> pairs_;
    std::atomic<std::uint32_t> size_ = 0;
};

}  // namespace bwfirt
