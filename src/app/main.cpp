// SPDX-License-Identifier: GPL-3.0-only
#include "app/Batch.h"
#include "app/CommandLine.h"
#include "app/ReplayRun.h"
#include "app/viewer/Viewer.h"
#include "kernel/KernelInfo.h"

#include <csignal>
#include <iostream>
#include <new>

namespace {

constexpr int DONE = 0, RUN_FAILED = 1, WRONG_USAGE = 2;

int complain(const std::string& message, int status) {
    std::cerr << "bwfirt-" << bwfirt::KernelInfo::NAME << ": " << message << std::endl;
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace bwfirt;
    // A write beyond the file size limit is then an error like any other.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        std::unique_ptr<RTKernel> kernel = createKernel();
        const std::optional<Settings> settings = parseCommandLine(argc, argv, *kernel);
        if (!settings)
            return DONE;
        if (!settings->replay.empty()) {
            runReplay(*settings, std::move(kernel));
            return DONE;
        }
        if (settings->batch)
            runBatch(*settings, std::move(kernel));
        else
            runViewer(*settings, std::move(kernel));
        return DONE;
    } catch (const UsageError& error) {
        return complain(error.what(), WRONG_USAGE);
    } catch (const std::bad_alloc&) {
        return complain("not enough memory", RUN_FAILED);
    } catch (const std::exception& error) {
        return complain(error.what(), RUN_FAILED);
    }
}
