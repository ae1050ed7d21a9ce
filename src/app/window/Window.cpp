// SPDX-License-Identifier: GPL-3.0-only
#include "app/window/Window.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace bwfirt {

namespace {

constexpr int FONT_PIXELS = 14;  // on a display of 96 dots per inch
constexpr int SMALLEST_SIDE = 64;
constexpr Uint8 PANEL_OPACITY = 190;

[[noreturn]] void failToOpen(const std::string& why) {
    throw std::runtime_error("cannot open a window: " + why + "; --batch needs none");
}

void require(bool isDone) {
    if (!isDone)
        failToOpen(SDL_GetError());
}

/// The file of a font in which all characters have the same width.
std::string monospaceFont() {
    FcPattern* pattern =
        FcNameParse(reinterpret_cast<const FcChar8*>("DejaVu Sans Mono,monospace:scalable=true"));
    FcConfigSubstitute(nullptr, pattern, FcMatchPattern);
    FcDefaultSubstitute(pattern);
    FcResult result{};
    FcPattern* match = FcFontMatch(nullptr, pattern, &result);
    FcChar8* file = nullptr;
    std::string name;
    if (match != nullptr && FcPatternGetString(match, FC_FILE, 0, &file) == FcResultMatch)
        name = reinterpret_cast<const char*>(file);
    if (match != nullptr)
        FcPatternDestroy(match);
    FcPatternDestroy(pattern);
    FcFini();
    if (name.empty())
        failToOpen("there is no font; install the Debian package fonts-dejavu-core");
    return name;
}

}  // namespace

Window::Libraries::Libraries() {
    // Wayland's library would complain on its own where there is no display.
    const bool hasWayland = std::getenv("WAYLAND_DISPLAY") != nullptr;
    SDL_SetHint(SDL_HINT_VIDEODRIVER, hasWayland ? "wayland,x11" : "x11");
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        failToOpen(std::string("there is no display (") + SDL_GetError() + ")");
    require(TTF_Init() == 0);
}

Window::Libraries::~Libraries() {
    TTF_Quit();
    SDL_Quit();
}

Window::Window(const std::string& title, int width, int height) {
    // Hidden at first: a renderer may need a window of another kind, which SDL then makes anew.
    window_.reset(SDL_CreateWindow(
        title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, width, height,
        SDL_WINDOW_HIDDEN | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
    require(window_ != nullptr);
    SDL_SetWindowMinimumSize(window_.get(), SMALLEST_SIDE, SMALLEST_SIDE);
    renderer_.reset(SDL_CreateRenderer(window_.get(), -1, 0));
    require(renderer_ != nullptr);
    require(SDL_SetRenderDrawBlendMode(renderer_.get(), SDL_BLENDMODE_BLEND) == 0);
    openFont();
    SDL_ShowWindow(window_.get());
}

void Window::openFont() {
    float dotsPerInch = 96;
    SDL_GetDisplayDPI(std::max(0, SDL_GetWindowDisplayIndex(window_.get())), nullptr, &dotsPerInch,
                      nullptr);
    int windowWidth = 1;
    SDL_GetWindowSize(window_.get(), &windowWidth, nullptr);
    const float scale = std::max(dotsPerInch / 96, static_cast<float>(width()) / windowWidth);
    const int pixels = static_cast<int>(std::lround(FONT_PIXELS * std::clamp(scale, 1.0F, 4.0F)));
    font_.reset(TTF_OpenFont(monospaceFont().c_str(), pixels));
    require(font_ != nullptr);
}

int Window::width() const {
    int width = 1;
    SDL_GetRendererOutputSize(renderer_.get(), &width, nullptr);
    return width;
}

int Window::height() const {
    int height = 1;
    SDL_GetRendererOutputSize(renderer_.get(), nullptr, &height);
    return height;
}

SDL_Point Window::pixelAt(int x, int y) const {
    int windowWidth = 1, windowHeight = 1;
    SDL_GetWindowSize(window_.get(), &windowWidth, &windowHeight);
    return {x * width() / windowWidth, y * height() / windowHeight};
}

bool Window::isHidden() const {
    return (SDL_GetWindowFlags(window_.get()) & (SDL_WINDOW_HIDDEN | SDL_WINDOW_MINIMIZED)) != 0;
}

void Window::toggleFullScreen() {
    const bool isFull = (SDL_GetWindowFlags(window_.get()) & SDL_WINDOW_FULLSCREEN) != 0;
    SDL_SetWindowFullscreen(window_.get(), isFull ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

void Window::setPicture(int width, int height, std::span<const std::uint8_t> pixels) {
    if (!picture_ || width != pictureWidth_ || height != pictureHeight_) {
        picture_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_RGB24,
                                         SDL_TEXTUREACCESS_STREAMING, width, height));
        require(picture_ != nullptr);
        pictureWidth_ = width;
        pictureHeight_ = height;
    }
    SDL_UpdateTexture(picture_.get(), nullptr, pixels.data(), 3 * width);
}

void Window::clear() {
    SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, 255);
    SDL_RenderClear(renderer_.get());
}

void Window::drawPicture() {
    if (picture_)
        SDL_RenderCopy(renderer_.get(), picture_.get(), nullptr, nullptr);
}

void Window::drawPolygon(std::span<const SDL_FPoint> corners, SDL_Color colour) {
    if (corners.empty())
        return;
    std::vector<SDL_FPoint> line(corners.begin(), corners.end());
    line.push_back(corners.front());
    const auto draw = [&](float dx, float dy, SDL_Color c) {
        std::vector<SDL_FPoint> moved = line;
        for (SDL_FPoint& point : moved)
            point = {point.x + dx, point.y + dy};
        SDL_SetRenderDrawColor(renderer_.get(), c.r, c.g, c.b, c.a);
        SDL_RenderDrawLinesF(renderer_.get(), moved.data(), static_cast<int>(moved.size()));
    };
    // A dark border keeps the line visible on a bright surface.
    for (const auto& [dx, dy] : {std::pair(-1.F, 0.F), {2.F, 0.F}, {0.F, -1.F}, {0.F, 2.F}})
        draw(dx, dy, {0, 0, 0, 255});
    for (const auto& [dx, dy] : {std::pair(0.F, 0.F), {1.F, 0.F}, {0.F, 1.F}})
        draw(dx, dy, colour);
}

std::unique_ptr<SDL_Texture, Window::Destroyer<SDL_DestroyTexture>> Window::textureOf(
    const TextLine& line) {
    const std::unique_ptr<SDL_Surface, Destroyer<SDL_FreeSurface>> surface(
        TTF_RenderUTF8_Blended(font_.get(), line.text.c_str(), line.colour));
    std::unique_ptr<SDL_Texture, Destroyer<SDL_DestroyTexture>> texture;
    if (surface)
        texture.reset(SDL_CreateTextureFromSurface(renderer_.get(), surface.get()));
    return texture;
}

void Window::drawPanel(Corner corner, const std::vector<TextLine>& lines,
                       const std::function<SDL_Color(double)>& colourAt) {
    const int lineHeight = TTF_FontLineSkip(font_.get());
    const int margin = lineHeight / 2;
    int textWidth = 0;
    for (const TextLine& line : lines) {
        int width = 0;
        TTF_SizeUTF8(font_.get(), line.text.c_str(), &width, nullptr);
        textWidth = std::max(textWidth, width);
    }
    const int rows = static_cast<int>(lines.size()) + (colourAt ? 1 : 0);
    SDL_Rect panel{margin, margin, textWidth + 2 * margin, rows * lineHeight + margin};
    // A panel that is too large for the window is drawn smaller.
    const float scale = std::min(
        {1.F, static_cast<float>(width()) / panel.w, static_cast<float>(height()) / panel.h});
    SDL_RenderSetScale(renderer_.get(), scale, scale);
    const auto free = [scale](int window, int used) {
        return std::max(0, static_cast<int>(window / scale) - used);
    };
    if (corner == Corner::LOWER_LEFT)
        panel.y = free(height(), panel.h + margin);
    if (corner == Corner::CENTRE) {
        panel.x = free(width(), panel.w) / 2;
        panel.y = free(height(), panel.h) / 2;
    }
    SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, PANEL_OPACITY);
    SDL_RenderFillRect(renderer_.get(), &panel);

    int y = panel.y + margin / 2;
    for (const TextLine& line : lines) {
        if (const auto texture = textureOf(line)) {
            SDL_Rect place{panel.x + margin, y, 0, 0};
            SDL_QueryTexture(texture.get(), nullptr, nullptr, &place.w, &place.h);
            SDL_RenderCopy(renderer_.get(), texture.get(), nullptr, &place);
        }
        y += lineHeight;
    }
    for (int x = 0; colourAt && x < textWidth; ++x) {
        const SDL_Color colour = colourAt(static_cast<double>(x) / textWidth);
        SDL_SetRenderDrawColor(renderer_.get(), colour.r, colour.g, colour.b, 255);
        SDL_RenderDrawLine(renderer_.get(), panel.x + margin + x, y, panel.x + margin + x,
                           y + lineHeight * 2 / 3);
    }
    SDL_RenderSetScale(renderer_.get(), 1, 1);
}

void Window::present() {
    SDL_RenderPresent(renderer_.get());
}

}  // namespace bwfirt
