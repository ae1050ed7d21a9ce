// SPDX-License-Identifier: GPL-3.0-only
#include "app/Batch.h"

#include "app/Progress.h"
#include "app/Run.h"
#include "film/ImageFile.h"
#include "kernel/KernelInfo.h"
#include "render/Checkpoint.h"
#include "render/RayStream.h"
#include "render/Renderer.h"
#include "scene/FileIO.h"

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace bwfirt {

namespace {

volatile std::sig_atomic_t endAfterThisPass = 0;

void catchSignals() {
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int) { endAfterThisPass = 1; });
}

void requireOutputsWritable(const Settings& settings) {
    if (!settings.output.empty()) {
        requireWritable(withEnding(settings.output, ".exr"));
        requireWritable(withEnding(settings.output, ".png"));
    }
    for (const auto& path : {settings.report, settings.checkpoint, settings.record})
        if (!path.empty())
            requireWritable(path);
    if (settings.reference)
        requireWritable(settings.camera);
}

RunIdentity identityOf(const Settings& settings, const Scene& scene, const Camera& camera) {
    std::string options;
    for (const auto& [name, value] : settings.kernelOptions)
        options += name + "=" + value + "\n";
    return {checksumOf(scene), checksumOf(camera), settings.seed,      settings.width,
            settings.height,   KernelInfo::NAME,   std::move(options), settings.viewName};
}

/// Renders a film pass by pass, and takes down what it took.
class Rendering {
  public:
    Rendering(const Settings& settings, Run& run, const Camera& camera)
        : settings_(settings), run_(run), camera_(camera), film_(settings.width, settings.height) {
        if (settings.checkpoint.empty())
            return;
        checkpoint_.emplace(settings.checkpoint, identityOf(settings, run.scene(), camera));
        checkpoint_->load(film_, run.report.rays, run.report.secondsRender);
        if (film_.passes() > settings.passes)
            throw std::runtime_error(
                settings.checkpoint.string() + ": holds " + std::to_string(film_.passes()) +
                " passes already, more than --passes " + std::to_string(settings.passes));
    }

    const Film& film() const { return film_; }

    void renderPasses() {
        if (settings_.view) {
            renderPasses(FalseColour(*settings_.view, run_.scene(), run_.kernel(), camera_,
                                     settings_.width, settings_.height,
                                     boundsOf(run_.scene()).size().length()));
            return;
        }
        const PathTracer pathTracer(run_.scene(), run_.kernel(), camera_, settings_.width,
                                    settings_.height, settings_.inFlight);
        if (settings_.record.empty())
            renderPasses(pathTracer);
        else
            record(pathTracer);
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds SAVING_INTERVAL{2};

    /// @param isEnough asked after each pass
    template <typename IsEnough>
    void renderPasses(const Integrator& integrator, int threads, const IsEnough& isEnough) {
        const Renderer renderer(integrator, settings_.seed, threads);
        RunReport& report = run_.report;
        Progress progress(settings_.passes - film_.passes());
        const int passesBefore = film_.passes();
        while (film_.passes() < settings_.passes && endAfterThisPass == 0 && !isEnough()) {
            report.secondsRender += secondsOf([&] { report.rays += renderer.renderPass(film_); });
            progress.show(film_.passes() - passesBefore, report.raysPerSecond());
            if (checkpoint_ && Clock::now() - lastSaved_ >= SAVING_INTERVAL)
                save();
        }
        if (film_.passes() == 0)
            throw std::runtime_error("ended by a signal before the first pass");
        if (checkpoint_ && film_.passes() > passesSaved_)
            save();
        if (film_.passes() < settings_.passes && endAfterThisPass != 0)
            report.warnings.push_back("ended by a signal after " + std::to_string(film_.passes()) +
                                      " of " + std::to_string(settings_.passes) + " passes");
    }

    void renderPasses(const Integrator& integrator) {
        renderPasses(integrator, settings_.threads, [] { return false; });
    }

    /// On one thread, since the order of the rays is part of the stream.
    void record(const PathTracer& pathTracer) {
        RayStreamWriter stream(settings_.record, run_.scene().triangles, KernelInfo::NAME,
                               settings_.raysToRecord);
        run_.report.threads = 1;
        renderPasses(RecordingPathTracer(pathTracer, stream), 1, [&] { return stream.isFull(); });
        stream.finish();
        run_.report.warnings.push_back(
            "the rays were recorded meanwhile: measure speed without --record");
    }

    void save() {
        checkpoint_->save(film_, run_.report.rays, run_.report.secondsRender);
        lastSaved_ = Clock::now();
        passesSaved_ = film_.passes();
    }

    const Settings& settings_;
    Run& run_;
    const Camera& camera_;
    Film film_;
    std::optional<Checkpoint> checkpoint_;  ///< nothing without --checkpoint
    Clock::time_point lastSaved_{};
    int passesSaved_ = 0;
};

std::string format(const char* pattern, double value) {
    char text[32];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

void setReference(const Settings& settings, const RunReport& report) {
    writeReference(
        settings.camera,
        referenceLine(report.averageIntensity,
                      std::string(KernelInfo::NAME) + ", " + std::to_string(report.width) + "x" +
                          std::to_string(report.height) + ", " + std::to_string(report.passes) +
                          " passes, seed " + std::to_string(report.seed) + "; standard error " +
                          format("%.1e", report.standardError.x)));
}

}  // namespace

void runBatch(const Settings& settings, std::unique_ptr<RTKernel> kernel) {
    catchSignals();
    requireOutputsWritable(settings);
    Camera camera;
    const double secondsLoadCamera = secondsOf([&] { camera = readCamera(settings.camera); });
    Run run(settings, std::move(kernel));
    run.report.secondsLoad += secondsLoadCamera;
    run.report.referenceAverageIntensity = camera.referenceAverageIntensity;
    const bool needsLights = !settings.view || *settings.view == View::QUERIES;
    if (run.scene().lights.empty() && needsLights)
        throw std::runtime_error(settings.scene.string() +
                                 ": has no lights, and light transport needs one");

    Rendering rendering(settings, run, camera);
    run.initializeKernel();
    rendering.renderPasses();
    run.measureKernelMemory();

    const Film& film = rendering.film();
    run.report.passes = film.passes();
    run.report.averageIntensity = film.averageIntensity();
    run.report.standardError = film.standardError();
    if (!settings.output.empty())
        writeImages(settings.output, film);
    if (settings.reference)
        setReference(settings, run.report);
    run.finish();
}

}  // namespace bwfirt
