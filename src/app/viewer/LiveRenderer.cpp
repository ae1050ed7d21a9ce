// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/LiveRenderer.h"

#include "app/viewer/ReferenceKernel.h"
#include "app/viewer/start-camera/SensorResponse.h"
#include "app/viewer/start-camera/StartCamera.h"
#include "kernel/KernelInfo.h"
#include "render/Renderer.h"
#include "scene/LightSampler.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace bwfirt {

namespace {

using Clock = std::chrono::steady_clock;

/// Before the first pass of a view tells how fast it is.
constexpr double FIRST_GUESS_OF_PIXELS_PER_SECOND = 5e4;

bool needsLights(const std::optional<View>& view) {
    return !view || *view == View::QUERIES || *view == View::ERRORS;
}

/// After a preview paths are not shown before there are enough of them to recognise something.
constexpr int DIVISOR_AFTER_PREVIEW = 4;

bool hasMoved(const std::optional<Wish>& before, const Wish& now) {
    if (!before || before->camera == now.camera)
        return false;
    Wish there = *before;
    there.camera = now.camera;
    return there == now;
}

/// The average of what can be shown, from 0 to 1; some light even where all is black.
float brightness(const std::vector<V3f>& pixels) {
    constexpr float DARKEST = 0.05F;
    float sum = 0;
    for (const V3f& pixel : pixels)
        sum += std::clamp(pixel.x, 0.F, 1.F);
    return std::max(DARKEST, sum / static_cast<float>(pixels.size()));
}

/// The time that nineteen of twenty pixels take at most: the others may have been interrupted.
double longestTime(const std::vector<V3f>& pixels) {
    std::vector<float> times;
    for (const V3f& pixel : pixels)
        times.push_back(pixel.x);
    const auto percentile = times.begin() + static_cast<std::ptrdiff_t>(times.size() * 19 / 20);
    std::nth_element(times.begin(), percentile, times.end());
    return *percentile;
}

}  // namespace

/// Ends a pass that nobody wants any more, after a few samples.
class LiveRenderer::Interruptible : public Integrator {
  public:
    Interruptible(const Integrator& integrator, const LiveRenderer& renderer, bool isFirst)
        : integrator_(integrator), renderer_(renderer), isFirst_(isFirst) {}

    void trace(std::span<Sample> samples, RayCounts& counts) const override {
        constexpr std::size_t CHUNK = 8;
        for (std::size_t begin = 0; begin < samples.size(); begin += CHUNK) {
            // The first picture of a wish is finished even if the next wish has come: otherwise
            // nothing would be seen while the camera moves.
            if (renderer_.isEnding_ || (!isFirst_ && renderer_.hasNewWish_))
                throw Cancelled();
            integrator_.trace(samples.subspan(begin, std::min(CHUNK, samples.size() - begin)),
                              counts);
        }
    }

  private:
    const Integrator& integrator_;
    const LiveRenderer& renderer_;
    bool isFirst_;
};

/// An integrator and those that it refers to.
struct LiveRenderer::Shown {
    std::optional<View> view;
    std::unique_ptr<PathTracer> pathTracer;
    std::unique_ptr<FalseColour> falseColour;
    std::unique_ptr<ErrorView> errors;

    const Integrator& integrator() const {
        if (errors)
            return *errors;
        if (falseColour)
            return *falseColour;
        return *pathTracer;
    }
};

LiveRenderer::LiveRenderer(const Settings& settings, std::unique_ptr<RTKernel> kernel)
    : settings_(settings), kernel_(std::move(kernel)) {
    if (!settings.camera.empty())
        startCamera_ = readCamera(settings.camera);
    thread_ = std::thread([this] { run(); });
}

LiveRenderer::~LiveRenderer() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

bool LiveRenderer::isReady() const {
    const std::lock_guard lock(mutex_);
    if (failure_)
        std::rethrow_exception(failure_);
    return isReady_;
}

void LiveRenderer::show(const Wish& wish) {
    {
        const std::lock_guard lock(mutex_);
        wish_ = wish;
        wished_ = Clock::now();
        hasNewWish_ = true;
    }
    changed_.notify_all();
}

void LiveRenderer::setPaused(bool isPaused) {
    {
        const std::lock_guard lock(mutex_);
        isPaused_ = isPaused;
    }
    changed_.notify_all();
}

std::shared_ptr<const Picture> LiveRenderer::picture() const {
    const std::lock_guard lock(mutex_);
    return picture_;
}

void LiveRenderer::run() {
    try {
        omp_set_num_threads(settings_.threads);  // for the kernel, which may build in parallel
        scene_ = readScene(settings_.scene);
        for (const std::string& warning : sceneWarnings(scene_))
            std::cerr << "bwfirt-" << KernelInfo::NAME << ": warning: " << warning << std::endl;
        startLights_ = scene_.lights;
        hasPower_ = !scene_.lights.empty();
        sceneDiagonal_ = boundsOf(scene_).size().length();
        stage_ = Stage::BUILDING;
        kernel_->kernelInitialize(scene_.triangles);
        if (settings_.camera.empty()) {
            startCamera_ = bwfirt::startCamera(scene_, *kernel_);
            startCamera_.sensorResponse = fittingSensorResponse(scene_, *kernel_, startCamera_);
        }
        stage_ = Stage::RENDERING;
        {
            const std::lock_guard lock(mutex_);
            isReady_ = true;
        }
        renderWishes();
    } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
    }
}

void LiveRenderer::renderWishes() {
    while (true) {
        Wish wish;
        Clock::time_point wished;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return isEnding_ || hasNewWish_; });
            if (isEnding_)
                return;
            wish = wish_;
            wished = wished_;
            hasNewWish_ = false;
        }
        try {
            renderWish(wish, wished);
        } catch (const Cancelled&) {
        }
    }
}

void LiveRenderer::renderWish(const Wish& wish, Clock::time_point wished) {
    if (wish.lights != scene_.lights) {
        scene_.lights = wish.lights;
        const double power = LightSampler(scene_).totalPower();
        hasPower_ = power > 0 && std::isfinite(power);
    }
    Picture picture;
    picture.wish = wish;
    picture.wished = wished;
    picture.isFirst = true;
    // The few paths that can be traced in time show hardly anything, and something else each time.
    // As long as the camera moves, an even light tells better where one is.
    picture.isPreview = !wish.view && hasPower_ && hasMoved(lastWish_, wish);
    lastWish_ = wish;
    int divisor = 0;
    if (picture.isPreview) {
        renderPasses(divisorInTime(wish, View::EVEN_LIGHT), picture);
        picture.isFirst = picture.isPreview = false;
        divisor = DIVISOR_AFTER_PREVIEW;
    } else {
        divisor = divisorInTime(wish, wish.view);
    }
    for (; divisor > 0; divisor /= 2) {
        renderPasses(divisor, picture);
        picture.isFirst = false;
    }
}

/// By how much an image must be smaller than the window for its pass to take
/// SECONDS_OF_FIRST_PASS.
int LiveRenderer::divisorInTime(const Wish& wish, const std::optional<View>& view) const {
    const auto known = pixelsPerSecond_.find(view);
    const double rate =
        known == pixelsPerSecond_.end() ? FIRST_GUESS_OF_PIXELS_PER_SECOND : known->second;
    const double pixels = static_cast<double>(wish.width) * wish.height;
    return std::clamp(
        static_cast<int>(std::ceil(std::sqrt(pixels / (rate * SECONDS_OF_FIRST_PASS)))), 1,
        std::max(1, std::min(wish.width, wish.height)));
}

/// A single pass of a preview, or of an image that is smaller by the divisor, or all passes of the
/// whole image.
void LiveRenderer::renderPasses(int divisor, Picture picture) {
    const Wish& wish = picture.wish;
    Film film(std::max(1, wish.width / divisor), std::max(1, wish.height / divisor));
    const Shown shown = makeShown(wish, picture.isPreview ? View::EVEN_LIGHT : wish.view,
                                  film.width(), film.height());
    picture.view = shown.view;
    picture.width = film.width();
    picture.height = film.height();
    if (wish.view == View::ERRORS && !shown.errors)
        picture.problem = problemOfReference_;
    double seconds = 0;
    while (true) {
        const Interruptible interruptible(shown.integrator(), *this, picture.isFirst);
        const Clock::time_point start = Clock::now();
        const RayCounts rays =
            Renderer(interruptible, settings_.seed, settings_.threads).renderPass(film);
        picture.secondsOfLastPass = std::chrono::duration<double>(Clock::now() - start).count();
        if (picture.isFirst)
            adapt(picture.view, film.width() * film.height() / picture.secondsOfLastPass);
        seconds += picture.secondsOfLastPass;
        picture.rays += rays.intersect + rays.visibility;
        picture.raysPerSecond = static_cast<double>(picture.rays) / seconds;
        picture.passes = film.passes();
        if (shown.errors)
            picture.differences = shown.errors->differences();
        picture.pixels.clear();
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                picture.pixels.emplace_back(film.mean(x, y));
        if (picture.view == View::TIME)
            picture.longestTime = longestTime(picture.pixels);
        if (!picture.view)
            brightnessOfLight_ = brightness(picture.pixels);
        if (picture.isPreview) {
            const float factor = brightnessOfLight_ / brightness(picture.pixels);
            for (V3f& pixel : picture.pixels)
                pixel *= factor;
        }

        auto published = std::make_shared<const Picture>(picture);
        std::unique_lock lock(mutex_);
        picture_ = std::move(published);
        picture.isFirst = false;
        if (divisor > 1 || picture.isPreview)
            return;
        changed_.wait(lock, [&] {
            return isEnding_ || hasNewWish_ || (!isPaused_ && film.passes() < settings_.passes);
        });
        if (isEnding_ || hasNewWish_)
            throw Cancelled();
    }
}

/// Halfway, since a pass may have been disturbed.
void LiveRenderer::adapt(const std::optional<View>& view, double pixelsPerSecond) {
    const auto [known, isNew] = pixelsPerSecond_.emplace(view, pixelsPerSecond);
    if (!isNew)
        known->second = std::sqrt(known->second * pixelsPerSecond);
}

LiveRenderer::Shown LiveRenderer::makeShown(const Wish& wish, const std::optional<View>& view,
                                            int width, int height) {
    const auto falseColour = [&](View view) {
        return std::make_unique<FalseColour>(view, scene_, *kernel_, wish.camera, width, height,
                                             sceneDiagonal_);
    };
    Shown shown;
    shown.view = view;
    if (needsLights(shown.view) && !hasPower_)
        shown.view = View::EVEN_LIGHT;
    if (shown.view == View::ERRORS && !hasReference())
        shown.view = View::EVEN_LIGHT;
    if (needsLights(shown.view))
        shown.pathTracer = std::make_unique<PathTracer>(scene_, *kernel_, wish.camera, width,
                                                        height, settings_.inFlight);
    if (shown.view == View::ERRORS) {
        shown.falseColour = falseColour(View::EVEN_LIGHT);
        shown.errors =
            std::make_unique<ErrorView>(*shown.pathTracer, *shown.falseColour, *reference_);
    } else if (shown.view) {
        shown.falseColour = falseColour(*shown.view);
    }
    return shown;
}

bool LiveRenderer::hasReference() {
    if (reference_ || !problemOfReference_.empty())
        return reference_ != nullptr;
    stage_ = Stage::BUILDING_REFERENCE;
    try {
        std::unique_ptr<RTKernel> reference = createReferenceKernel();
        reference->kernelInitialize(scene_.triangles);
        reference_ = std::move(reference);
    } catch (const std::exception& error) {
        problemOfReference_ = error.what();
    }
    stage_ = Stage::RENDERING;
    return reference_ != nullptr;
}

}  // namespace bwfirt
