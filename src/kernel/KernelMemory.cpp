// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelMemory.h"

#include "kernel/RTKernel.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

namespace bwfirt {

namespace {

std::atomic<std::size_t> now{0};
std::atomic<std::size_t> peak{0};

/// Stands directly in front of the bytes that the kernel sees.
struct Header {
    void* block;
    std::size_t bytes;
    std::size_t alignment;
};

Header& headerOf(void* pointer) {
    return static_cast<Header*>(pointer)[-1];
}

/// Bytes of the block that malloc has to give for `bytes` behind a header, wherever it begins.
std::size_t blockSize(std::size_t bytes, std::size_t alignment) {
    const std::size_t extra = sizeof(Header) + alignment;
    if (bytes > std::numeric_limits<std::size_t>::max() / 2 - extra)
        throw std::bad_alloc();
    return bytes + extra;
}

/// The first aligned address of the block that leaves room for the header.
char* firstAligned(void* block, std::size_t alignment) {
    const auto begin = reinterpret_cast<std::uintptr_t>(block);
    const std::uintptr_t after = begin + sizeof(Header) + alignment - 1;
    return static_cast<char*>(block) + (after / alignment * alignment - begin);
}

}  // namespace

std::size_t KernelMemory::bytesNow() {
    return now.load();
}
std::size_t KernelMemory::bytesPeak() {
    return peak.load();
}
void KernelMemory::resetPeak() {
    peak.store(now.load());
}

void RTKernel::kernel_count(std::ptrdiff_t bytes) {
    const std::size_t after =
        now.fetch_add(static_cast<std::size_t>(bytes)) + static_cast<std::size_t>(bytes);
    if (bytes < 0)
        return;
    std::size_t highest = peak.load();
    while (highest < after && !peak.compare_exchange_weak(highest, after)) {
    }
}

void* RTKernel::kernel_malloc(std::size_t bytes, std::size_t alignment) {
    assert(std::has_single_bit(alignment));
    alignment = std::max(alignment, alignof(Header));
    void* block = std::malloc(blockSize(bytes, alignment));
    if (block == nullptr)
        throw std::bad_alloc();
    char* pointer = firstAligned(block, alignment);
    headerOf(pointer) = {block, bytes, alignment};
    kernel_count(static_cast<std::ptrdiff_t>(bytes));
    return pointer;
}

void* RTKernel::kernel_realloc(void* pointer, std::size_t bytes) {
    if (pointer == nullptr)
        return kernel_malloc(bytes);
    const Header old = headerOf(pointer);
    const std::ptrdiff_t offset = static_cast<char*>(pointer) - static_cast<char*>(old.block);

    // A block at another remainder of the alignment wants the content at another offset. No offset
    // is larger than what blockSize adds, so realloc keeps all of the content.
    void* block = std::realloc(old.block, blockSize(bytes, old.alignment));
    if (block == nullptr)
        throw std::bad_alloc();
    char* result = firstAligned(block, old.alignment);
    std::memmove(result, static_cast<char*>(block) + offset, std::min(bytes, old.bytes));
    headerOf(result) = {block, bytes, old.alignment};
    kernel_count(static_cast<std::ptrdiff_t>(bytes - old.bytes));
    return result;
}

void RTKernel::kernel_free(void* pointer) {
    if (pointer == nullptr)
        return;
    const Header header = headerOf(pointer);
    kernel_count(-static_cast<std::ptrdiff_t>(header.bytes));
    std::free(header.block);
}

}  // namespace bwfirt
