// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"

/// All that the shared library shows of itself.
extern "C" [[gnu::visibility("default")]] bwfirt::RTKernel* newReferenceKernel() {
    return bwfirt::createKernel().release();
}
