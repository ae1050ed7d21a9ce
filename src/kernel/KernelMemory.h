// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstddef>

namespace bwfirt {

/// What the counting allocators of RTKernel have handed out, in bytes as they were asked for.
/// There is one kernel in a process, and so one account. Exact while many threads allocate.
struct KernelMemory {
    static std::size_t bytesNow();
    static std::size_t bytesPeak();

    /// Makes the present amount the peak.
    static void resetPeak();
};

}  // namespace bwfirt
