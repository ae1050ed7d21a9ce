// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>

namespace bwfirt {

/// Memory for many small objects that are made by the threads of OpenMP and given back together.
/// Each thread cuts its objects from a block of its own.
class Arena {
  public:
    Arena() : open_(static_cast<std::size_t>(omp_get_max_threads())) {}
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;
    ~Arena() {
        for (void* block : blocks_)
            RTKernel::kernel_free(block);
    }

    /// An object that lives as long as the arena; it is not destroyed. @throws std::bad_alloc
    template <typename T, typename... Arguments>
    T* make(Arguments&&... arguments) {
        static_assert(std::is_trivially_destructible_v<T> && sizeof(T) <= BLOCK_SIZE);
        auto& [next, end] = open_[static_cast<std::size_t>(omp_get_thread_num())];
        constexpr std::size_t ALIGNMENT = std::max<std::size_t>(alignof(T), 16);
        std::size_t address = (next + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
        if (address + sizeof(T) > end) {
            address = openBlock();
            end = address + BLOCK_SIZE;
        }
        next = address + sizeof(T);
        return new (reinterpret_cast<void*>(address)) T{std::forward<Arguments>(arguments)...};
    }

  private:
    static constexpr std::size_t BLOCK_SIZE = 1 << 16;

    /// What is left of a block, as addresses; in a cache line of its own.
    struct alignas(64) Open {
        std::size_t next = 0;
        std::size_t end = 0;
    };

    std::size_t openBlock() {
        const std::scoped_lock lock(mutex_);
        blocks_.push_back(nullptr);
        blocks_.back() = RTKernel::kernel_malloc(BLOCK_SIZE, 64);
        return reinterpret_cast<std::size_t>(blocks_.back());
    }

    KernelVector<Open> open_;  ///< by thread
    std::mutex mutex_;
    KernelVector<void*> blocks_;
};

}  // namespace bwfirt
