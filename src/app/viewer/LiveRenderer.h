// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/Settings.h"
#include "kernel/RTKernel.h"
#include "render/ErrorView.h"
#include "scene/Scene.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

namespace bwfirt {

/// What somebody wants to see.
struct Wish {
    Camera camera;
    int width = 1;  ///< in pixels
    int height = 1;
    std::vector<Light> lights;
    std::optional<View> view;  ///< nothing: light transport

    bool operator==(const Wish&) const = default;
};

/// The means of some passes.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<V3f> pixels;  ///< linear RGB, rows from the top
    double longestTime = 0;   ///< View::TIME: most pixels take less, in seconds of h
    int passes = 0;
    double secondsOfLastPass = 0;
    double raysPerSecond = 0;  ///< in all these passes
    Wish wish;
    std::chrono::steady_clock::time_point wished;
    bool isFirst = false;      ///< of this wish
    bool isPreview = false;    ///< in an even light, as bright as the last picture of real light
    std::optional<View> view;  ///< other than wished for where that needs lights and there are none
    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> differences{};  ///< View::ERRORS: so far
    std::uint64_t rays = 0;
    std::string problem;  ///< why the view is not the one wished for; empty where it is
};

/// Loads a scene, lets the kernel build, and renders what is wished for, all beside its caller. A
/// new wish is first answered at a resolution that takes little time, then finer and finer, then
/// pass by pass for ever. Where only the camera has moved, a preview comes first.
class LiveRenderer {
  public:
    enum class Stage { LOADING, BUILDING, RENDERING, BUILDING_REFERENCE };

    /// A pass of the first picture after a wish should take so long: with as long for a pass that
    /// is under way, and the drawing, a picture reacts within a tenth of a second.
    static constexpr double SECONDS_OF_FIRST_PASS = 0.025;

    /// @throws std::runtime_error for a bad camera file; what is wrong with the scene comes later
    LiveRenderer(const Settings& settings, std::unique_ptr<RTKernel> kernel);

    /// Returns when the chunk of rays under way has been traced.
    ~LiveRenderer();
    LiveRenderer(const LiveRenderer&) = delete;
    LiveRenderer& operator=(const LiveRenderer&) = delete;

    Stage stage() const { return stage_; }

    /// Whether the scene is loaded and the kernel built, after which the functions below may be
    /// called. @throws what loading, building or rendering has thrown
    bool isReady() const;

    std::span<const Triangle> triangles() const { return scene_.triangles; }
    const std::vector<Light>& startLights() const { return startLights_; }
    const RTKernel& kernel() const { return *kernel_; }
    double sceneDiagonal() const { return sceneDiagonal_; }

    /// The camera of the settings, or one that is made for the scene.
    const Camera& startCamera() const { return startCamera_; }

    /// Shows this from now on.
    void show(const Wish& wish);

    /// While it pauses, a picture is not refined beyond one pass at full resolution.
    void setPaused(bool isPaused);

    /// The last picture; nothing before the first.
    std::shared_ptr<const Picture> picture() const;

  private:
    struct Cancelled {};
    class Interruptible;
    struct Shown;

    void run();
    void renderWishes();
    void renderWish(const Wish& wish, std::chrono::steady_clock::time_point wished);
    void renderPasses(int divisor, Picture picture);
    int divisorInTime(const Wish& wish, const std::optional<View>& view) const;
    void adapt(const std::optional<View>& view, double pixelsPerSecond);
    Shown makeShown(const Wish& wish, const std::optional<View>& view, int width, int height);
    bool hasReference();

    const Settings settings_;
    Scene scene_;                       ///< with the lights of the last wish
    std::unique_ptr<RTKernel> kernel_;  ///< destroyed before its triangles
    std::vector<Light> startLights_;
    bool hasPower_ = false;  ///< the lights of scene_
    double sceneDiagonal_ = 0;
    Camera startCamera_;
    std::unique_ptr<RTKernel> reference_;  ///< built when it is first needed
    std::string problemOfReference_;
    std::optional<Wish> lastWish_;
    std::map<std::optional<View>, double> pixelsPerSecond_;  ///< of first passes
    float brightnessOfLight_ = 0.5;                          ///< the last picture's

    std::atomic<Stage> stage_ = Stage::LOADING;
    std::atomic<bool> isEnding_ = false;
    std::atomic<bool> hasNewWish_ = false;

    mutable std::mutex mutex_;  ///< of what follows
    std::condition_variable changed_;
    bool isReady_ = false;
    bool isPaused_ = false;
    Wish wish_;
    std::chrono::steady_clock::time_point wished_;
    std::shared_ptr<const Picture> picture_;
    std::exception_ptr failure_;

    std::thread thread_;
};

}  // namespace bwfirt
