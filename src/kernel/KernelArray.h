// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"

namespace bwfirt {

struct KernelFree {
    void operator()(void* pointer) const { RTKernel::kernel_free(pointer); }
};

/// An array that counts as the kernel's memory. Unlike KernelVector it leaves its elements unset,
/// so that the threads that fill it are the first to touch it. Elements are not destroyed.
template <typename T>
using KernelArray = std::unique_ptr<T[], KernelFree>;

/// @throws std::bad_alloc
template <typename T>
KernelArray<T> makeKernelArray(std::size_t size, std::size_t alignment = alignof(T)) {
    return KernelArray<T>(static_cast<T*>(RTKernel::kernel_malloc(size * sizeof(T), alignment)));
}

/// Keeps the first elements, which can be copied as bytes. @throws std::bad_alloc
template <typename T>
void shrink(KernelArray<T>& array, std::size_t size) {
    void* const memory = RTKernel::kernel_realloc(array.get(), size * sizeof(T));
    static_cast<void>(array.release());
    array.reset(static_cast<T*>(memory));
}

}  // namespace bwfirt
