// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Viewer.h"

#include "app/viewer/Files.h"
#include "app/viewer/Keys.h"
#include "app/viewer/Texts.h"
#include "app/window/Window.h"
#include "film/ColourMap.h"
#include "film/ImageFile.h"
#include "kernel/KernelInfo.h"
#include "report/BuildInfo.h"
#include "scene/FileIO.h"

#include <cstdlib>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>

namespace bwfirt {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int MILLISECONDS_PER_TICK = 10;
constexpr std::chrono::seconds MESSAGE_TIME{5};
constexpr double RADIANS_PER_WINDOW_HEIGHT = std::numbers::pi / 2;
constexpr int LARGEST_CLICK = 3;  // a hand trembles so many pixels
constexpr double STOPS_PER_KEY = 0.5;

constexpr SDL_Color WHITE{240, 240, 240, 255};
constexpr SDL_Color ORANGE{255, 170, 60, 255};

std::string programName() {
    return std::string("bwfirt-") + KernelInfo::NAME;
}

double secondsSince(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
}

bool isRecent(Clock::time_point time) {
    return Clock::now() < time + MESSAGE_TIME;
}

std::vector<TextLine> inColour(const Lines& lines, SDL_Color colour) {
    std::vector<TextLine> coloured;
    for (const std::string& line : lines)
        coloured.push_back({line, colour});
    return coloured;
}

void append(std::vector<TextLine>& lines, const Lines& more, SDL_Color colour) {
    const std::vector<TextLine> coloured = inColour(more, colour);
    lines.insert(lines.end(), coloured.begin(), coloured.end());
}

SDL_Color colourOfScale(double value) {
    const V3d colour = viridis(value);
    return {encodeSrgb(colour.x), encodeSrgb(colour.y), encodeSrgb(colour.z), 255};
}

/// The window, what it shows, and what its user does.
class Viewer {
  public:
    Viewer(const Settings& settings, std::unique_ptr<RTKernel> kernel);

    /// Until the user quits.
    void run();

  private:
    /// A mouse button that is held.
    struct Drag {
        Uint8 button;
        SDL_Point start;
        SDL_Point last;
        bool hasMoved = false;
    };
    struct Message {
        std::string text;
        Clock::time_point shown;
    };

    void handle(const SDL_Event& event);
    void handleKey(const SDL_KeyboardEvent& event);
    void handleWindow(const SDL_WindowEvent& event);
    void handleMotion(const SDL_MouseMotionEvent& event);
    void handleButtonUp(const SDL_MouseButtonEvent& event);

    void execute(Command command);
    void move(Command command, bool isPressed);
    void choose(std::optional<View> view);
    void pickAt(int x, int y);
    void editLights(const std::function<void()>& edit);
    void saveCamera();
    void savePicture();
    void saveScene();
    void pause();

    void start();
    void step();
    void updateWish();
    void updatePicture();
    void draw();
    void drawOutline();
    void drawPanels();
    void drawHelp();
    void drawProgress();
    void say(const std::string& text);

    template <typename Work>
    void attempt(const Work& work);

    const Settings& settings_;
    const std::vector<KeyRow> keys_ = keyTable(BuildInfo::DVORAK);
    std::map<std::pair<SDL_Keycode, bool>, Command> commands_;  ///< by key and Ctrl
    Window window_;
    LiveRenderer renderer_;

    // From start() on.
    std::optional<Flight> flight_;
    std::optional<LightEditor> editor_;

    std::optional<View> view_;
    std::shared_ptr<const Picture> picture_;
    std::optional<Wish> wish_;
    std::optional<Pick> pick_;
    std::optional<Drag> drag_;
    std::optional<Message> message_;
    Exposure exposure_;
    double secondsOfReaction_ = 0;
    std::string progress_;
    Clock::time_point opened_ = Clock::now();
    Clock::time_point viewChosen_{};
    Clock::time_point lastStep_ = Clock::now();
    Clock::time_point lastDrawn_{};
    bool isInLightMode_ = false, showsHelp_ = false, showsStatus_ = false;
    bool isPaused_ = false, isHidden_ = false;
    bool needsDrawing_ = true, isQuitting_ = false;
};

Viewer::Viewer(const Settings& settings, std::unique_ptr<RTKernel> kernel)
    : settings_(settings),
      window_(settings.scene.filename().string() + " - " + programName() + " (h: help)",
              settings.width, settings.height),
      renderer_(settings, std::move(kernel)),
      view_(settings.view) {
    for (const KeyRow& row : keys_)
        for (const KeyBinding& binding : row.bindings)
            commands_[{SDL_GetKeyFromName(binding.key.c_str()), binding.withControl}] =
                binding.command;
}

void Viewer::run() {
    while (!isQuitting_) {
        SDL_Event event;
        if (SDL_WaitEventTimeout(&event, MILLISECONDS_PER_TICK) == 1) {
            do
                handle(event);
            while (!isQuitting_ && SDL_PollEvent(&event) == 1);
        }
        if (!isQuitting_)
            step();
    }
    if (!renderer_.isReady())
        std::_Exit(EXIT_SUCCESS);  // a kernel cannot be stopped while it builds
}

// ---- What the user does -------------------------------------------------------------------------

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
        case SDL_MOUSEBUTTONDOWN:
            if (!drag_)
                drag_ = {event.button.button,
                         {event.button.x, event.button.y},
                         {event.button.x, event.button.y}};
            break;
        case SDL_MOUSEMOTION:
            handleMotion(event.motion);
            break;
        case SDL_MOUSEBUTTONUP:
            handleButtonUp(event.button);
            break;
        case SDL_MOUSEWHEEL:
            if (flight_)
                flight_->changeSpeed(event.wheel.y);
            needsDrawing_ = true;
            break;
        default:
            break;
    }
}

void Viewer::handleWindow(const SDL_WindowEvent& event) {
    needsDrawing_ = true;
    switch (event.event) {
        case SDL_WINDOWEVENT_FOCUS_LOST:
            if (flight_)
                flight_->releaseAll();
            drag_.reset();
            break;
        case SDL_WINDOWEVENT_MINIMIZED:
        case SDL_WINDOWEVENT_HIDDEN:
            isHidden_ = true;
            break;
        case SDL_WINDOWEVENT_RESTORED:
        case SDL_WINDOWEVENT_SHOWN:
        case SDL_WINDOWEVENT_EXPOSED:
            isHidden_ = false;
            break;
        default:
            return;
    }
    pause();
}

void Viewer::handleKey(const SDL_KeyboardEvent& event) {
    const bool isPressed = event.state == SDL_PRESSED;
    const bool withControl = isPressed && (event.keysym.mod & KMOD_CTRL) != 0;
    const auto found = commands_.find({event.keysym.sym, withControl});
    if (found == commands_.end() || (isPressed && (event.keysym.mod & (KMOD_ALT | KMOD_GUI)) != 0))
        return;
    const Command command = found->second;
    if (command <= Command::FAST) {
        if (flight_ && event.repeat == 0)
            move(command, isPressed);
        return;
    }
    const bool isGradual = command == Command::SPEED_UP || command == Command::SLOW_DOWN ||
                           command == Command::MORE_EXPOSURE || command == Command::LESS_EXPOSURE ||
                           command == Command::MORE_EXITANCE || command == Command::LESS_EXITANCE;
    const bool worksWhileLoading =
        command == Command::QUIT || command == Command::FULLSCREEN || command == Command::HELP;
    if (isPressed && (event.repeat == 0 || isGradual) && (flight_ || worksWhileLoading)) {
        execute(command);
        needsDrawing_ = true;
    }
}

void Viewer::handleMotion(const SDL_MouseMotionEvent& event) {
    if (!drag_)
        return;
    const int dx = event.x - drag_->start.x, dy = event.y - drag_->start.y;
    if (dx * dx + dy * dy > LARGEST_CLICK * LARGEST_CLICK)
        drag_->hasMoved = true;
    if (!drag_->hasMoved)
        return;
    const SDL_Point from = drag_->last;
    drag_->last = {event.x, event.y};
    if (drag_->button != SDL_BUTTON_LEFT || !flight_)
        return;
    const double perPixel = RADIANS_PER_WINDOW_HEIGHT / window_.height();
    const SDL_Point a = window_.pixelAt(from.x, from.y), b = window_.pixelAt(event.x, event.y);
    flight_->look(perPixel * (b.x - a.x), perPixel * (b.y - a.y));
}

void Viewer::handleButtonUp(const SDL_MouseButtonEvent& event) {
    if (!drag_ || drag_->button != event.button)
        return;
    if (!drag_->hasMoved && flight_)
        attempt([&] { pickAt(event.x, event.y); });
    drag_.reset();
    needsDrawing_ = true;
}

void Viewer::move(Command command, bool isPressed) {
    static const std::map<Command, Flight::Direction> DIRECTIONS = {
        {Command::FORWARD, Flight::FORWARD}, {Command::BACK, Flight::BACK},
        {Command::LEFT, Flight::LEFT},       {Command::RIGHT, Flight::RIGHT},
        {Command::DOWN, Flight::DOWN},       {Command::UP, Flight::UP}};
    if (command == Command::FAST)
        flight_->setFast(isPressed);
    else if (isPressed)
        flight_->press(DIRECTIONS.at(command));
    else
        flight_->release(DIRECTIONS.at(command));
}

void Viewer::execute(Command command) {
    using enum Command;
    switch (command) {
        case SPEED_UP:
            flight_->changeSpeed(1);
            break;
        case SLOW_DOWN:
            flight_->changeSpeed(-1);
            break;
        case LIGHT_MODE:
            isInLightMode_ = !isInLightMode_;
            break;
        case UNDO:
            editLights([&] {
                if (!editor_->undo())
                    say("nothing to undo");
            });
            break;
        case MORE_EXITANCE:
            editLights([&] { editor_->changeExitance(1); });
            break;
        case LESS_EXITANCE:
            editLights([&] { editor_->changeExitance(-1); });
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
            exposure_.stops += STOPS_PER_KEY;
            break;
        case LESS_EXPOSURE:
            exposure_.stops -= STOPS_PER_KEY;
            break;
        case RESET_EXPOSURE:
            exposure_ = {};
            break;
        case BACK_TO_START:
            flight_->backToStart();
            break;
        case PAUSE:
            isPaused_ = !isPaused_;
            pause();
            break;
        case FULLSCREEN:
            window_.toggleFullScreen();
            break;
        case HELP:
            showsHelp_ = !showsHelp_;
            break;
        case STATUS:
            showsStatus_ = !showsStatus_;
            break;
        case QUIT:
            isQuitting_ = true;
            break;
        default:
            break;
    }
    if (command == MORE_EXPOSURE || command == LESS_EXPOSURE || command == RESET_EXPOSURE)
        updatePicture();
}

void Viewer::choose(std::optional<View> view) {
    view_ = view_ == view ? std::nullopt : view;
    viewChosen_ = Clock::now();
}

void Viewer::pause() {
    renderer_.setPaused(isPaused_ || isHidden_);
}

void Viewer::pickAt(int x, int y) {
    const SDL_Point pixel = window_.pixelAt(x, y);
    const CameraRays rays(flight_->camera(), window_.width(), window_.height());
    pick_ = pick(rays, pixel.x + 0.5, pixel.y + 0.5, renderer_.kernel(), renderer_.triangles());
    std::cout << describe(pick_) << std::endl;
    if (pick_ && isInLightMode_)
        editLights([&] { editor_->toggle(pick_->triangle); });
}

void Viewer::editLights(const std::function<void()>& edit) {
    const std::vector<Light> before = editor_->lights();
    edit();
    if (editor_->lights() != before)
        std::cout << lightsText(editor_->lights()) << std::endl;
}

void Viewer::saveCamera() {
    const std::filesystem::path path = newFile(settings_.scene, ".camera");
    const std::string text =
        cameraText(flight_->camera(), path.string() + ": seen in the viewer with --size " +
                                          std::to_string(window_.width()) + "x" +
                                          std::to_string(window_.height()));
    writeFileAtomically(path, text);
    std::cout << text << std::flush;
    say("camera written to " + path.string());
}

void Viewer::savePicture() {
    if (!picture_)
        return;
    const std::filesystem::path path = newFile(settings_.scene, ".png");
    writePng(path, window_.width(), window_.height(),
             enlarged(displayed(*picture_, exposure_), picture_->width, picture_->height,
                      window_.width(), window_.height()));
    std::cout << "picture " << path.string() << " passes " << picture_->passes << std::endl;
    say("picture written to " + path.string());
}

void Viewer::saveScene() {
    if (!editor_->isChanged()) {
        say("the lights are as in the file");
        return;
    }
    const std::filesystem::path backup = saveLights(settings_.scene, editor_->lights());
    editor_->markSaved();
    std::cout << "scene " << settings_.scene.string() << " backup " << backup.string() << std::endl;
    say("lights written; the old file is now " + backup.filename().string());
}

/// A failure is told and the viewer goes on.
template <typename Work>
void Viewer::attempt(const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        std::cerr << programName() << ": " << error.what() << std::endl;
        say(error.what());
    }
}

// ---- What the window shows ----------------------------------------------------------------------

void Viewer::start() {
    flight_.emplace(renderer_.startCamera(), renderer_.sceneDiagonal());
    editor_.emplace(renderer_.triangles(), renderer_.startLights());
    lastStep_ = Clock::now();
    if (renderer_.startLights().empty())
        say("the scene has no lights: l, then click on triangles that shall be one");
}

void Viewer::step() {
    const bool isReady = renderer_.isReady();
    if (!isReady || renderer_.stage() != LiveRenderer::Stage::RENDERING)
        drawProgress();
    if (!isReady)
        return;
    if (!flight_)
        start();
    flight_->advance(secondsSince(lastStep_));
    lastStep_ = Clock::now();
    updateWish();
    if (renderer_.picture() != picture_) {
        picture_ = renderer_.picture();
        updatePicture();
    }
    const auto isOver = [&](Clock::time_point shown) {
        return !isRecent(shown) && lastDrawn_ < shown + MESSAGE_TIME;
    };
    if (isOver(viewChosen_) || (message_ && isOver(message_->shown)))
        needsDrawing_ = true;
    if (needsDrawing_)
        draw();
}

void Viewer::updateWish() {
    const Wish wish{flight_->camera(), window_.width(), window_.height(), editor_->lights(), view_};
    if (wish_ == wish)
        return;
    wish_ = wish;
    renderer_.show(wish);
}

void Viewer::updatePicture() {
    if (!picture_)
        return;
    window_.setPicture(picture_->width, picture_->height, displayed(*picture_, exposure_));
    needsDrawing_ = true;
}

void Viewer::draw() {
    needsDrawing_ = false;
    lastDrawn_ = Clock::now();
    window_.clear();
    window_.drawPicture();
    if (picture_)
        drawOutline();
    if (showsHelp_)
        drawHelp();
    else if (picture_)
        drawPanels();
    window_.present();
    if (picture_ && picture_->isFirst)
        secondsOfReaction_ = secondsSince(picture_->wished);
}

void Viewer::drawOutline() {
    if (!pick_)
        return;
    const CameraRays rays(picture_->wish.camera, window_.width(), window_.height());
    std::vector<SDL_FPoint> corners;
    for (const Imath::V2f& point :
         outline(renderer_.triangles()[pick_->triangle], rays, window_.width(), window_.height()))
        corners.push_back({point.x, point.y});
    window_.drawPolygon(corners, ORANGE);
}

void Viewer::drawPanels() {
    std::vector<TextLine> upper, lower;
    if (showsStatus_)
        upper = inColour(statusLines(*picture_, settings_, *flight_, exposure_, secondsOfReaction_),
                         WHITE);
    if (isPaused_)
        upper.push_back({"paused", ORANGE});
    append(upper, pickLines(pick_), ORANGE);
    const bool showsLegend =
        showsStatus_ || picture_->view == View::EVEN_LIGHT || isRecent(viewChosen_);
    if (showsLegend)
        append(upper, legendLines(*picture_, renderer_.sceneDiagonal(), exposure_), WHITE);
    if (isInLightMode_)
        lower = inColour(lightLines(*editor_), WHITE);
    if (message_ && isRecent(message_->shown))
        lower.push_back({message_->text, ORANGE});

    if (!upper.empty())
        window_.drawPanel(Window::Corner::UPPER_LEFT, upper,
                          showsLegend && isScale(picture_->view) ? colourOfScale : nullptr);
    if (!lower.empty())
        window_.drawPanel(Window::Corner::LOWER_LEFT, lower);
}

void Viewer::drawHelp() {
    std::vector<TextLine> lines;
    std::istringstream help(keyHelp(keys_));
    for (std::string line; std::getline(help, line);)
        lines.push_back({line, WHITE});
    window_.drawPanel(Window::Corner::CENTRE, lines);
}

void Viewer::drawProgress() {
    const std::string text = progressText(renderer_.stage(), secondsSince(opened_));
    if (text.empty() || (text == progress_ && !needsDrawing_))
        return;
    progress_ = text;
    window_.clear();
    window_.drawPicture();
    window_.drawPanel(Window::Corner::CENTRE, {{text, WHITE}});
    window_.present();
    needsDrawing_ = flight_.has_value();
}

void Viewer::say(const std::string& text) {
    message_ = {text, Clock::now()};
    needsDrawing_ = true;
}

}  // namespace

void runViewer(const Settings& settings, std::unique_ptr<RTKernel> kernel) {
    Viewer(settings, std::move(kernel)).run();
}

std::string viewerHelp() {
    return "The viewer, without --batch:\n" + keyHelp(keyTable(BuildInfo::DVORAK));
}

}  // namespace bwfirt
