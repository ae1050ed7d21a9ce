// SPDX-License-Identifier: GPL-3.0-only
#include "app/Batch.h"

#include "app/Progress.h"
#include "film/ImageFile.h"
#include "kernel/KernelInfo.h"
#include "kernel/KernelMemory.h"
#include "render/Renderer.h"
#include "report/RunReport.h"
#include "report/SystemInfo.h"
#include "scene/FileIO.h"

#include <omp.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <stdexcept>

namespace bwfirt {

namespace {

volatile std::sig_atomic_t endAfterThisPass = 0;

void catchSignals() {
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int) { endAfterThisPass = 1; });
    // A write beyond the file size limit is then an error like any other.
    std::signal(SIGXFSZ, SIG_IGN);
}

/// Seconds that a call takes.
template <typename Call>
double secondsOf(const Call& call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void requireOutputsWritable(const Settings& settings) {
    if (!settings.output.empty()) {
        requireWritable(withEnding(settings.output, ".exr"));
        requireWritable(withEnding(settings.output, ".png"));
    }
    if (!settings.report.empty())
        requireWritable(settings.report);
}

std::unique_ptr<Integrator> makeIntegrator(const Settings& settings, const Scene& scene,
                                           const Camera& camera, const RTKernel& kernel) {
    if (settings.view)
        return std::make_unique<FalseColour>(*settings.view, scene, kernel, camera, settings.width,
                                             settings.height);
    return std::make_unique<PathTracer>(scene, kernel, camera, settings.width, settings.height,
                                        settings.inFlight);
}

void renderPasses(const Settings& settings, const Integrator& integrator, Film& film,
                  RunReport& report) {
    const Renderer renderer(integrator, settings.seed, settings.threads);
    Progress progress(settings.passes);
    while (film.passes() < settings.passes && endAfterThisPass == 0) {
        report.secondsRender += secondsOf([&] { report.rays += renderer.renderPass(film); });
        progress.show(film.passes(), report.raysPerSecond());
    }
    if (film.passes() == 0)
        throw std::runtime_error("ended by a signal before the first pass");
    if (film.passes() < settings.passes)
        report.warnings.push_back("ended by a signal after " + std::to_string(film.passes()) +
                                  " of " + std::to_string(settings.passes) + " passes");
}

/// A warning where the process grew by much more than the counting allocators saw.
void checkKernelMemory(const ProcessMemory& before, RunReport& report) {
    const std::uint64_t peak = processMemory().bytesPeak;
    const std::uint64_t grown = peak > before.bytesPeak ? peak - before.bytesNow : 0;
    const std::uint64_t counted = report.kernelBytesPeak;
    constexpr std::uint64_t ALLOWANCE = 16 << 20;
    if (grown > counted + counted / 4 + ALLOWANCE)
        report.warnings.push_back(
            "the process grew by " + std::to_string(grown / 1000000) +
            " MB since the kernel was initialised, but the kernel's allocators counted only " +
            std::to_string(counted / 1000000) + " MB: the kernel's memory figures are too small");
}

RunReport describe(const Settings& settings, const Scene& scene, const Camera& camera) {
    RunReport report;
    for (const auto& [name, value] : settings.kernelOptions)
        report.kernelOptions.push_back({name, value, ""});
    report.scene = settings.scene.string();
    report.camera = settings.camera.string();
    report.view = settings.viewName;
    report.triangles = scene.triangles.size();
    report.trianglesBytes = scene.triangles.size() * sizeof(Triangle);
    report.threads = settings.threads;
    report.inFlight = settings.inFlight;
    report.width = settings.width;
    report.height = settings.height;
    report.seed = settings.seed;
    report.referenceAverageIntensity = camera.referenceAverageIntensity;
    report.warnings = sceneWarnings(scene);
    return report;
}

}  // namespace

void runBatch(const Settings& settings, std::unique_ptr<RTKernel> givenKernel) {
    catchSignals();
    requireOutputsWritable(settings);
    omp_set_num_threads(settings.threads);  // for the kernel, which may build in parallel

    Scene scene;
    std::unique_ptr<RTKernel> kernel = std::move(givenKernel);  // destroyed before its triangles
    Camera camera;
    const double secondsLoad = secondsOf([&] {
        camera = readCamera(settings.camera);
        scene = readScene(settings.scene);
    });
    const bool needsLights = !settings.view || *settings.view == View::QUERIES;
    if (scene.lights.empty() && needsLights)
        throw std::runtime_error(settings.scene.string() +
                                 ": has no lights, and light transport needs one");

    RunReport report = describe(settings, scene, camera);
    report.secondsLoad = secondsLoad;
    Film film(settings.width, settings.height);

    const ProcessMemory before = processMemory();
    report.secondsInitialize = secondsOf([&] { kernel->kernelInitialize(scene.triangles); });
    renderPasses(settings, *makeIntegrator(settings, scene, camera, *kernel), film, report);

    report.kernelBytesPeak = KernelMemory::bytesPeak();
    report.kernelBytesFinal = KernelMemory::bytesNow();
    checkKernelMemory(before, report);
    kernel.reset();
    report.kernelBytesLeaked = KernelMemory::bytesNow();
    if (report.kernelBytesLeaked > 0)
        report.warnings.push_back("the kernel leaked " + std::to_string(report.kernelBytesLeaked) +
                                  " bytes");
    report.processBytesPeak = processMemory().bytesPeak;
    report.passes = film.passes();
    report.averageIntensity = film.averageIntensity();
    report.standardError = film.standardError();

    if (!settings.output.empty())
        writeImages(settings.output, film);
    if (!settings.report.empty())
        writeFileAtomically(settings.report, reportAsJson(report));
    for (const std::string& warning : report.warnings)
        std::cerr << "bwfirt-" << KernelInfo::NAME << ": warning: " << warning << "\n";
    std::cout << reportAsText(report) << std::flush;
    if (!std::cout)
        throw std::runtime_error("standard output: cannot be written");
}

}  // namespace bwfirt
