// SPDX-License-Identifier: GPL-3.0-only
#include "app/Run.h"

#include "kernel/KernelInfo.h"
#include "kernel/KernelMemory.h"
#include "scene/FileIO.h"

#include <omp.h>

#include <iostream>
#include <stdexcept>

namespace bwfirt {

Run::Run(const Settings& settings, std::unique_ptr<RTKernel> kernel)
    : settings_(settings), kernel_(std::move(kernel)) {
    report.secondsLoad = secondsOf([&] { scene_ = readScene(settings.scene); });
    for (const auto& [name, value] : settings.kernelOptions)
        report.kernelOptions.push_back({name, value, ""});
    report.scene = settings.scene.string();
    report.camera = settings.camera.string();
    report.view = settings.viewName;
    report.triangles = scene_.triangles.size();
    report.trianglesBytes = scene_.triangles.size() * sizeof(Triangle);
    report.threads = settings.threads;
    report.inFlight = settings.inFlight;
    report.width = settings.width;
    report.height = settings.height;
    report.seed = settings.seed;
    report.warnings = sceneWarnings(scene_);
}

void Run::initializeKernel() {
    omp_set_num_threads(settings_.threads);  // for the kernel, which may build in parallel
    before_ = processMemory();
    report.secondsInitialize = secondsOf([&] { kernel_->kernelInitialize(scene_.triangles); });
    report.kernelDescription = kernel_->kernelDescription();
}

void Run::measureKernelMemory() {
    report.kernelBytesPeak = KernelMemory::bytesPeak();
    report.kernelBytesFinal = KernelMemory::bytesNow();
    const std::uint64_t peak = processMemory().bytesPeak;
    const std::uint64_t grown = peak > before_.bytesPeak ? peak - before_.bytesNow : 0;
    const std::uint64_t counted = report.kernelBytesPeak;
    constexpr std::uint64_t ALLOWANCE = 16 << 20;
    if (grown > counted + counted / 4 + ALLOWANCE)
        report.warnings.push_back(
            "the process grew by " + std::to_string(grown / 1000000) +
            " MB since the kernel was initialised, but the kernel's allocators counted only " +
            std::to_string(counted / 1000000) + " MB: the kernel's memory figures are too small");
}

void Run::finish() {
    kernel_.reset();
    report.kernelBytesLeaked = KernelMemory::bytesNow();
    if (report.kernelBytesLeaked > 0)
        report.warnings.push_back("the kernel leaked " + std::to_string(report.kernelBytesLeaked) +
                                  " bytes");
    report.processBytesPeak = processMemory().bytesPeak;
    if (!settings_.report.empty())
        writeFileAtomically(settings_.report, reportAsJson(report));
    for (const std::string& warning : report.warnings)
        std::cerr << "bwfirt-" << KernelInfo::NAME << ": warning: " << warning << "\n";
    std::cout << reportAsText(report) << std::flush;
    if (!std::cout)
        throw std::runtime_error("standard output: cannot be written");
}

}  // namespace bwfirt
