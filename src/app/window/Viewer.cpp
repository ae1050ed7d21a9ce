// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Viewer.h"

#include "app/viewer/Texts.h"
#include "app/window/Input.h"
#include "app/window/Overlay.h"
#include "kernel/KernelInfo.h"
#include "report/BuildInfo.h"

#include <cstdlib>

namespace bwfirt {

namespace {

constexpr int MILLISECONDS_PER_TICK = 5;

std::string titleOf(const Settings& settings) {
    return settings.scene.filename().string() + " - bwfirt-" + KernelInfo::NAME + " (h: help)";
}

/// The window and its event loop.
class Viewer {
  public:
    Viewer(const Settings& settings, std::unique_ptr<RTKernel> kernel)
        : settings_(settings),
          window_(titleOf(settings), settings.width, settings.height),
          renderer_(settings, std::move(kernel)) {}

    /// Until the user quits.
    void run();

  private:
    void handle(const SDL_Event& event);
    void handleKey(const SDL_KeyboardEvent& event);
    void handleWindow(const SDL_WindowEvent& event);
    void update();
    void draw();

    const Settings& settings_;
    const std::vector<KeyRow> keys_ = keyTable(BuildInfo::DVORAK);
    Window window_;
    Input input_{keys_};
    LiveRenderer renderer_;
    std::optional<ViewerState> state_;  ///< once the renderer is ready
    std::shared_ptr<const Picture> drawnPicture_;
    Exposure drawnExposure_;
    std::string progress_;
    std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
    bool showsHelp_ = false;
    bool needsDrawing_ = true;
    bool isQuitting_ = false;
};

void Viewer::run() {
    while (!isQuitting_) {
        update();
        // SDL_WaitEventTimeout would sometimes send an event to a window that it then closes, over
        // a second connection to the display: an error of X11 that ends the program.
        SDL_Delay(MILLISECONDS_PER_TICK);
        for (SDL_Event event; !isQuitting_ && SDL_PollEvent(&event) == 1;)
            handle(event);
    }
    if (!renderer_.isReady())
        std::_Exit(EXIT_SUCCESS);  // a kernel cannot be stopped while it builds
}

void Viewer::handle(const SDL_Event& event) {
    switch (event.type) {
        case SDL_QUIT:
            isQuitting_ = true;
            break;
        case SDL_WINDOWEVENT:
            handleWindow(event.window);
            break;
        case SDL_KEYDOWN:
        case SDL_KEYUP:
            handleKey(event.key);
            break;
        default:
            if (state_)
                input_.handleMouse(event, window_, *state_);
    }
}

void Viewer::handleKey(const SDL_KeyboardEvent& event) {
    const std::optional<Command> command = input_.commandOf(event);
    if (!command)
        return;
    needsDrawing_ = true;
    if (event.state == SDL_RELEASED) {
        if (state_)
            state_->release(*command);
    } else if (command == Command::QUIT) {
        isQuitting_ = true;
    } else if (command == Command::FULLSCREEN) {
        window_.toggleFullScreen();
    } else if (command == Command::HELP) {
        showsHelp_ = !showsHelp_;
    } else if (state_) {
        state_->press(*command);
    }
}

void Viewer::handleWindow(const SDL_WindowEvent& event) {
    needsDrawing_ = true;
    if (state_ && event.event == SDL_WINDOWEVENT_FOCUS_LOST) {
        state_->releaseAll();
        input_.releaseMouse();
    }
}

void Viewer::update() {
    const bool isReady = renderer_.isReady();
    if (isReady && !state_)
        state_.emplace(settings_, renderer_);
    if (state_) {
        state_->resize(window_.width(), window_.height());
        state_->setHidden(window_.isHidden());
        needsDrawing_ |= state_->update();
    }
    std::string progress = progressText(
        renderer_.stage(),
        std::chrono::duration<double>(std::chrono::steady_clock::now() - opened_).count());
    if (progress != progress_ || needsDrawing_) {
        progress_ = std::move(progress);
        draw();
        needsDrawing_ = false;
    }
}

void Viewer::draw() {
    const std::shared_ptr<const Picture> picture = state_ ? state_->picture() : nullptr;
    if (picture && (picture != drawnPicture_ || state_->exposure() != drawnExposure_)) {
        drawnPicture_ = picture;
        drawnExposure_ = state_->exposure();
        window_.setPicture(picture->width, picture->height, displayed(*picture, drawnExposure_));
    }
    window_.clear();
    window_.drawPicture();
    if (showsHelp_)
        drawHelp(window_, keys_);
    else if (!progress_.empty())
        drawProgress(window_, progress_);
    else if (picture)
        drawOverlay(window_, *state_, settings_, renderer_);
    window_.present();
    if (state_)
        state_->drawn();
}

}  // namespace

void runViewer(const Settings& settings, std::unique_ptr<RTKernel> kernel) {
    Viewer(settings, std::move(kernel)).run();
}

std::string viewerHelp() {
    return "The viewer, without --batch:\n" + keyHelp(keyTable(BuildInfo::DVORAK));
}

}  // namespace bwfirt
