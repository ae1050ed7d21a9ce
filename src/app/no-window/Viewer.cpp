// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Viewer.h"

#include "app/CommandLine.h"

namespace bwfirt {

void runViewer(const Settings&, std::unique_ptr<RTKernel>) {
    throw UsageError("this build has no viewer; use --batch and --camera FILE");
}

std::string viewerHelp() {
    return "This build has no viewer.\n";
}

}  // namespace bwfirt
