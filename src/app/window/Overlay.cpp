// SPDX-License-Identifier: GPL-3.0-only
#include "app/window/Overlay.h"

#include "app/viewer/Texts.h"
#include "film/ColourMap.h"
#include "film/ImageFile.h"

#include <sstream>

namespace bwfirt {

namespace {

constexpr SDL_Color WHITE{240, 240, 240, 255};
constexpr SDL_Color ORANGE{255, 170, 60, 255};

void append(std::vector<TextLine>& lines, const Lines& more, SDL_Color colour) {
    for (const std::string& line : more)
        lines.push_back({line, colour});
}

SDL_Color colourOfScale(double value) {
    const V3d colour = viridis(value);
    return {encodeSrgb(colour.x), encodeSrgb(colour.y), encodeSrgb(colour.z), 255};
}

void drawOutline(Window& window, const Picture& picture, const Triangle& triangle) {
    const CameraRays rays(picture.wish.camera, window.width(), window.height());
    std::vector<SDL_FPoint> corners;
    for (const Imath::V2f& point : outline(triangle, rays, window.width(), window.height()))
        corners.push_back({point.x, point.y});
    window.drawPolygon(corners, ORANGE);
}

}  // namespace

void drawOverlay(Window& window, const ViewerState& state, const Settings& settings,
                 const LiveRenderer& renderer) {
    const Picture& picture = *state.picture();
    if (state.pick())
        drawOutline(window, picture, renderer.triangles()[state.pick()->triangle]);

    std::vector<TextLine> upper, lower;
    if (state.showsStatus())
        append(upper,
               statusLines(picture, settings, state.flight(), state.exposure(),
                           state.secondsOfReaction()),
               WHITE);
    if (state.isPaused())
        upper.push_back({"paused", ORANGE});
    append(upper, pickLines(state.pick()), ORANGE);
    if (state.showsLegend())
        append(upper, legendLines(picture, renderer.sceneDiagonal(), state.exposure()), WHITE);
    if (!upper.empty())
        window.drawPanel(Window::Corner::UPPER_LEFT, upper,
                         state.showsLegend() && isScale(picture.view) ? colourOfScale : nullptr);

    if (state.isInLightMode())
        append(lower, lightLines(state.editor()), WHITE);
    if (!state.message().empty())
        lower.push_back({state.message(), ORANGE});
    if (!lower.empty())
        window.drawPanel(Window::Corner::LOWER_LEFT, lower);
}

void drawHelp(Window& window, const std::vector<KeyRow>& keys) {
    std::vector<TextLine> lines;
    std::istringstream help(keyHelp(keys));
    for (std::string line; std::getline(help, line);)
        lines.push_back({line, WHITE});
    window.drawPanel(Window::Corner::CENTRE, lines);
}

void drawProgress(Window& window, const std::string& text) {
    window.drawPanel(Window::Corner::CENTRE, {{text, WHITE}});
}

}  // namespace bwfirt
