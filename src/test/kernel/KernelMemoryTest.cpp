// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelMemory.h"

#include "kernel/RTKernel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <new>

namespace bwfirt {
namespace {

bool isAligned(const void* pointer, std::size_t alignment) {
    return reinterpret_cast<std::uintptr_t>(pointer) % alignment == 0;
}

TEST(KernelMemory, CountsBytesNowAndPeak) {
    KernelMemory::resetPeak();
    ASSERT_EQ(KernelMemory::bytesNow(), 0u);
    void* a = RTKernel::kernel_malloc(1000);
    void* b = RTKernel::kernel_malloc(500);
    RTKernel::kernel_free(a);
    a = RTKernel::kernel_malloc(100);
    EXPECT_EQ(KernelMemory::bytesNow(), 600u);
    EXPECT_EQ(KernelMemory::bytesPeak(), 1500u);
    RTKernel::kernel_free(a);
    RTKernel::kernel_free(b);
    RTKernel::kernel_free(nullptr);
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
}

TEST(KernelMemory, CountsWhatLibrariesTell) {
    KernelMemory::resetPeak();
    RTKernel::kernel_count(700);
    RTKernel::kernel_count(-200);
    EXPECT_EQ(KernelMemory::bytesNow(), 500u);
    EXPECT_EQ(KernelMemory::bytesPeak(), 700u);
    RTKernel::kernel_count(-500);
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
}

TEST(KernelMemory, HonoursEveryAlignment) {
    for (std::size_t alignment = 1; alignment <= 1 << 21; alignment *= 2) {
        void* pointer = RTKernel::kernel_malloc(100, alignment);
        EXPECT_TRUE(isAligned(pointer, alignment)) << alignment;
        std::memset(pointer, 0xff, 100);
        RTKernel::kernel_free(pointer);
    }
}

TEST(KernelMemory, ReallocKeepsContentAndAlignment) {
    for (const std::size_t alignment : {16, 64, 4096}) {
        auto* bytes = static_cast<unsigned char*>(RTKernel::kernel_malloc(1, alignment));
        bytes[0] = 0;
        std::size_t size = 1;
        for (const std::size_t wanted : {7, 5000, 300000, 3000000, 1234, 10, 100000, 1}) {
            bytes = static_cast<unsigned char*>(RTKernel::kernel_realloc(bytes, wanted));
            ASSERT_TRUE(isAligned(bytes, alignment));
            EXPECT_EQ(KernelMemory::bytesNow(), wanted);
            for (std::size_t i = 0; i < std::min(size, wanted); ++i)
                ASSERT_EQ(bytes[i], i % 251) << "after growing to " << wanted;
            for (std::size_t i = size; i < wanted; ++i)
                bytes[i] = i % 251;
            size = wanted;
        }
        RTKernel::kernel_free(bytes);
    }
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
}

TEST(KernelMemory, ReallocOfNothingAllocates) {
    void* pointer = RTKernel::kernel_realloc(nullptr, 10);
    EXPECT_EQ(KernelMemory::bytesNow(), 10u);
    RTKernel::kernel_free(pointer);
}

TEST(KernelMemory, TooMuchIsBadAllocAndCountsNothing) {
    EXPECT_THROW(RTKernel::kernel_malloc(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
    EXPECT_THROW(RTKernel::kernel_malloc(std::numeric_limits<std::size_t>::max() / 4, 64),
                 std::bad_alloc);
    void* pointer = RTKernel::kernel_malloc(10);
    EXPECT_THROW(RTKernel::kernel_realloc(pointer, std::numeric_limits<std::size_t>::max() / 4),
                 std::bad_alloc);
    EXPECT_EQ(KernelMemory::bytesNow(), 10u);
    RTKernel::kernel_free(pointer);
}

// All threads hold their blocks at the same time between the barriers, so that the peak is known.
TEST(KernelMemory, IsExactWhileManyThreadsAllocate) {
    constexpr int THREADS = 8, BLOCKS = 2000;
    KernelMemory::resetPeak();
#pragma omp parallel num_threads(THREADS)
    {
        std::vector<void*> blocks(BLOCKS);
        for (std::size_t i = 0; i < BLOCKS; ++i)
            blocks[i] = RTKernel::kernel_malloc(i % 100);
        for (void*& block : blocks)
            block = RTKernel::kernel_realloc(block, 200);
#pragma omp barrier
#pragma omp single
        EXPECT_EQ(KernelMemory::bytesNow(), 200u * THREADS * BLOCKS);
        for (void* block : blocks)
            RTKernel::kernel_free(block);
    }
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
    EXPECT_EQ(KernelMemory::bytesPeak(), 200u * THREADS * BLOCKS);
}

TEST(KernelAllocator, CountsStandardContainers) {
    {
        KernelVector<std::uint64_t> numbers;
        numbers.reserve(100);
        EXPECT_EQ(KernelMemory::bytesNow(), 800u);
        numbers.assign(100, 7);
        const KernelVector<std::uint64_t> copy = numbers;
        EXPECT_EQ(KernelMemory::bytesNow(), 1600u);
    }
    EXPECT_EQ(KernelMemory::bytesNow(), 0u);
}

struct alignas(128) Wide {
    char bytes[128];
};

TEST(KernelAllocator, AlignsAsTheTypeAsks) {
    const KernelVector<Wide> wide(3);
    EXPECT_TRUE(isAligned(wide.data(), 128));
}

}  // namespace
}  // namespace bwfirt
