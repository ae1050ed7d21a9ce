// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/ViewerState.h"

#include "app/viewer/Files.h"
#include "film/ImageFile.h"
#include "kernel/KernelInfo.h"
#include "scene/FileIO.h"

#include <iostream>
#include <map>
#include <numbers>

namespace bwfirt {

namespace {

constexpr std::chrono::seconds TIME_TO_READ{5};
constexpr double RADIANS_PER_WINDOW_HEIGHT = std::numbers::pi / 2;
constexpr double STOPS_PER_KEY = 0.5;

const std::map<Command, Flight::Direction> DIRECTIONS = {
    {Command::FORWARD, Flight::FORWARD}, {Command::BACK, Flight::BACK},
    {Command::LEFT, Flight::LEFT},       {Command::RIGHT, Flight::RIGHT},
    {Command::DOWN, Flight::DOWN},       {Command::UP, Flight::UP}};

}  // namespace

ViewerState::ViewerState(const Settings& settings, LiveRenderer& renderer)
    : settings_(settings),
      renderer_(renderer),
      flight_(renderer.startCamera(), renderer.sceneDiagonal()),
      editor_(renderer.triangles(), renderer.startLights()),
      view_(settings.view),
      width_(settings.width),
      height_(settings.height) {}

void ViewerState::resize(int width, int height) {
    isChanged_ |= width != width_ || height != height_;
    width_ = width;
    height_ = height;
}

void ViewerState::press(Command command) {
    using enum Command;
    isChanged_ = true;
    if (const auto direction = DIRECTIONS.find(command); direction != DIRECTIONS.end())
        flight_.press(direction->second);
    switch (command) {
        case FAST:
            flight_.setFast(true);
            break;
        case SPEED_UP:
            changeSpeed(1);
            break;
        case SLOW_DOWN:
            changeSpeed(-1);
            break;
        case BACK_TO_START:
            flight_.backToStart();
            break;
        case LIGHT_MODE:
            isInLightMode_ = !isInLightMode_;
            break;
        case UNDO:
            editLights([&] {
                if (!editor_.undo())
                    say("nothing to undo");
            });
            break;
        case MORE_EXITANCE:
            editLights([&] { editor_.changeExitance(1); });
            break;
        case LESS_EXITANCE:
            editLights([&] { editor_.changeExitance(-1); });
            break;
        case SAVE_SCENE:
            attempt([&] { saveScene(); });
            break;
        case SAVE_CAMERA:
            attempt([&] { saveCamera(); });
            break;
        case SAVE_PICTURE:
            attempt([&] { savePicture(); });
            break;
        case VIEW_LIGHT:
            choose(std::nullopt);
            break;
        case VIEW_NORMALS:
            choose(View::NORMALS);
            break;
        case VIEW_TRIANGLES:
            choose(View::TRIANGLES);
            break;
        case VIEW_DISTANCE:
            choose(View::DISTANCE);
            break;
        case VIEW_QUERIES:
            choose(view_ == View::QUERIES ? View::TIME : View::QUERIES);
            break;
        case VIEW_ERRORS:
            choose(View::ERRORS);
            break;
        case MORE_EXPOSURE:
            expose(exposure_.stops + STOPS_PER_KEY);
            break;
        case LESS_EXPOSURE:
            expose(exposure_.stops - STOPS_PER_KEY);
            break;
        case RESET_EXPOSURE:
            expose(0);
            break;
        case PAUSE:
            isPaused_ = !isPaused_;
            pause();
            break;
        case STATUS:
            showsStatus_ = !showsStatus_;
            break;
        default:
            break;  // the window's
    }
}

void ViewerState::release(Command command) {
    if (command == Command::FAST)
        flight_.setFast(false);
    if (const auto direction = DIRECTIONS.find(command); direction != DIRECTIONS.end())
        flight_.release(direction->second);
}

void ViewerState::look(int pixelsRight, int pixelsDown) {
    const double perPixel = RADIANS_PER_WINDOW_HEIGHT / height_;
    flight_.look(perPixel * pixelsRight, perPixel * pixelsDown);
}

void ViewerState::changeSpeed(int steps) {
    flight_.changeSpeed(steps);
    isChanged_ = true;
}

void ViewerState::pickAt(int x, int y) {
    const CameraRays rays(flight_.camera(), width_, height_);
    pick_ = bwfirt::pick(rays, x + 0.5, y + 0.5, renderer_.kernel(), renderer_.triangles());
    isChanged_ = true;
    std::cout << describe(pick_) << std::endl;
    if (pick_ && isInLightMode_)
        editLights([&] { editor_.toggle(pick_->triangle); });
}

void ViewerState::setHidden(bool isHidden) {
    if (isHidden == isHidden_)
        return;
    isHidden_ = isHidden;
    pause();
}

void ViewerState::pause() {
    renderer_.setPaused(isPaused_ || isHidden_);
}

void ViewerState::choose(std::optional<View> view) {
    view_ = view_ == view ? std::nullopt : view;
    legendShown_ = {Clock::now()};
}

void ViewerState::expose(double stops) {
    exposure_ = {stops};
}

void ViewerState::editLights(const std::function<void()>& edit) {
    const std::vector<Light> before = editor_.lights();
    edit();
    if (editor_.lights() != before)
        std::cout << lightsText(editor_.lights()) << std::endl;
}

/// A failure is told, and the viewer goes on.
void ViewerState::attempt(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        std::cerr << "bwfirt-" << KernelInfo::NAME << ": " << error.what() << std::endl;
        say(error.what());
    }
}

void ViewerState::saveCamera() {
    const std::filesystem::path path = newFile(settings_.scene, ".camera");
    const std::string text =
        cameraText(flight_.camera(), path.string() + ": seen in the viewer with --size " +
                                         std::to_string(width_) + "x" + std::to_string(height_));
    writeFileAtomically(path, text);
    std::cout << text << std::flush;
    say("camera written to " + path.string());
}

void ViewerState::savePicture() {
    if (!picture_)
        return;
    const std::filesystem::path path = newFile(settings_.scene, ".png");
    writePng(path, width_, height_,
             enlarged(displayed(*picture_, exposure_), picture_->width, picture_->height, width_,
                      height_));
    std::cout << "picture " << path.string() << " passes " << picture_->passes << std::endl;
    say("picture written to " + path.string());
}

void ViewerState::saveScene() {
    if (!editor_.isChanged()) {
        say("the lights are as in the file");
        return;
    }
    const std::filesystem::path backup = saveLights(settings_.scene, editor_.lights());
    editor_.markSaved();
    std::cout << "scene " << settings_.scene.string() << " backup " << backup.string() << std::endl;
    say("lights written; the old file is now " + backup.filename().string());
}

void ViewerState::say(const std::string& text) {
    message_ = text;
    messageShown_ = {Clock::now()};
    isChanged_ = true;
}

bool ViewerState::update() {
    const Clock::time_point now = Clock::now();
    flight_.advance(std::chrono::duration<double>(now - lastUpdate_).count());
    lastUpdate_ = now;
    updateWish();
    if (renderer_.picture() != picture_) {
        picture_ = renderer_.picture();
        isChanged_ = true;
    }
    for (Moment* moment : {&messageShown_, &legendShown_}) {
        if (moment->begin != Clock::time_point() && moment->isOver()) {
            *moment = {};
            isChanged_ = true;
        }
    }
    return isChanged_;
}

void ViewerState::updateWish() {
    const Wish wish{flight_.camera(), width_, height_, editor_.lights(), view_};
    if (wish_ == wish)
        return;
    wish_ = wish;
    renderer_.show(wish);
}

void ViewerState::drawn() {
    isChanged_ = false;
    if (!picture_ || picture_->wished == answered_)
        return;
    answered_ = picture_->wished;
    secondsOfReaction_ = std::chrono::duration<double>(Clock::now() - answered_).count();
}

bool ViewerState::Moment::isOver() const {
    return Clock::now() > begin + TIME_TO_READ;
}

bool ViewerState::showsLegend() const {
    return showsStatus_ || !legendShown_.isOver() ||
           (picture_ && picture_->view == View::EVEN_LIGHT && !picture_->isPreview);
}

std::string ViewerState::message() const {
    return messageShown_.isOver() ? "" : message_;
}

}  // namespace bwfirt
