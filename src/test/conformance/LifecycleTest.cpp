// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelMemory.h"
#include "test/conformance/Conformance.h"

namespace bwfirt::test {
namespace {

TEST(Lifecycle, AllMemoryIsGivenBack) {
    std::mt19937 random(10);
    ASSERT_EQ(KernelMemory::bytesNow(), 0u);
    for (const std::size_t count : {0, 1, 1000}) {
        const Triangles triangles = soup(count, 0.3, random);
        auto kernel = kernelFor(triangles);
#pragma omp parallel for num_threads(8)
        for (int i = 0; i < 100; ++i) {
            kernel->kernelIntersectGeometry({V3f(0), V3f(1, 0, 0)});
            kernel->kernelVisibility(V3f(0), V3f(1));
        }
        kernel.reset();
        EXPECT_EQ(KernelMemory::bytesNow(), 0u) << "after " << count << " triangles";
    }
    createKernel().reset();
    EXPECT_EQ(KernelMemory::bytesNow(), 0u) << "without kernelInitialize";
}

TEST(Lifecycle, EveryOptionTakesItsDefault) {
    const auto kernel = createKernel();
    for (const KernelOption& option : kernel->kernelOptions()) {
        EXPECT_NO_THROW(kernel->kernelSetOption(option.name, option.value)) << option.name;
        EXPECT_FALSE(option.meaning.empty()) << option.name;
    }
}

}  // namespace
}  // namespace bwfirt::test
