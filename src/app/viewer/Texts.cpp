// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Texts.h"

#include <cstdio>

namespace bwfirt {

namespace {

template <typename... Values>
std::string format(const char* pattern, Values... values) {
    const int length = std::snprintf(nullptr, 0, pattern, values...);
    std::string text(static_cast<std::size_t>(length), ' ');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
}

std::string format(const V3d& v) {
    return format("%.5g %.5g %.5g", v.x, v.y, v.z);
}

Lines errorLines(const Picture& picture) {
    std::uint64_t errors = 0;
    std::string kinds;
    for (std::size_t kind = 0; kind < picture.differences.size(); ++kind) {
        const std::uint64_t count = picture.differences[kind];
        if (count == 0)
            continue;
        if (static_cast<Difference>(kind) != Difference::TIE)
            errors += count;
        kinds += (kinds.empty() ? "" : ", ") + std::string(DIFFERENCE_NAMES[kind]) + " " +
                 std::to_string(count);
    }
    Lines lines = {format("errors: %llu of %llu answers differ from those of simple-bvh",
                          static_cast<unsigned long long>(errors),
                          static_cast<unsigned long long>(picture.rays)),
                   "red: h missed or wrong, yellow: h ghost, cyan: V wrong"};
    if (!kinds.empty())
        lines.push_back(kinds);
    return lines;
}

}  // namespace

std::string progressText(LiveRenderer::Stage stage, double seconds) {
    switch (stage) {
        case LiveRenderer::Stage::LOADING:
            return format("loading the scene, %.1f s", seconds);
        case LiveRenderer::Stage::BUILDING:
            return format("the kernel builds, %.1f s", seconds);
        case LiveRenderer::Stage::BUILDING_REFERENCE:
            return "simple-bvh builds, to compare answers with";
        case LiveRenderer::Stage::RENDERING:
            break;
    }
    return "";
}

Lines statusLines(const Picture& picture, const Settings& settings, const Flight& flight,
                  Exposure exposure, double secondsOfReaction) {
    const bool isWhole = picture.width == picture.wish.width;
    Lines lines = {
        format("passes %d, %.2f Mrays/s, %d threads", picture.passes, picture.raysPerSecond / 1e6,
               settings.threads),
        format("%dx%d%s, pass %.0f ms, reaction %.0f ms", picture.wish.width, picture.wish.height,
               isWhole ? "" : format(" by %dx%d", picture.width, picture.height).c_str(),
               1e3 * picture.secondsOfLastPass, 1e3 * secondsOfReaction),
        "position " + format(picture.wish.camera.position),
        "direction " + format(picture.wish.camera.direction.normalized()),
        format("speed %.3g per second", flight.speed())};
    if (picture.isPreview)
        lines.push_back("even light while the camera moves");
    if (exposure.stops != 0)
        lines.push_back(format("exposure %+.1f stops", exposure.stops));
    return lines;
}

bool isScale(const std::optional<View>& view) {
    return view == View::DISTANCE || view == View::QUERIES || view == View::TIME;
}

Lines legendLines(const Picture& picture, double sceneDiagonal, Exposure exposure) {
    if (!picture.view || picture.isPreview)
        return {};
    switch (*picture.view) {
        case View::NORMALS:
            return {"normals: x red, y green, z blue"};
        case View::TRIANGLES:
            return {"triangles: a colour for each"};
        case View::DISTANCE:
            return {format("distance: 0 to %.4g", sceneDiagonal)};
        case View::QUERIES:
            return {"queries of h and V a path: 0 to 32"};
        case View::TIME:
            return {format("time of h: 0 to %.3g us", 1e6 * longestTime(picture, exposure))};
        case View::ERRORS:
            return errorLines(picture);
        case View::EVEN_LIGHT:
            break;
    }
    if (!picture.problem.empty())
        return {"even light: nothing to compare with", picture.problem};
    return {"even light: there are no lights", "l and a click on a triangle make one"};
}

Lines pickLines(const std::optional<Pick>& pick) {
    if (!pick)
        return {};
    return {format("triangle %u", pick->triangle), format("distance %.6g", pick->distance),
            "point " + format(pick->point), "normal " + format(pick->normal),
            format("area %.6g", pick->area)};
}

Lines lightLines(const LightEditor& editor) {
    constexpr std::size_t MOST = 6;
    const std::vector<Light>& lights = editor.lights();
    Lines lines = {
        "light mode: a click adds or removes a triangle",
        format("%zu light%s%s, a new one gets %g", lights.size(), lights.size() == 1 ? "" : "s",
               editor.isChanged() ? ", not saved (Ctrl+S)" : "", editor.exitance())};
    for (std::size_t i = 0; i < std::min(MOST, lights.size()); ++i)
        lines.push_back(
            format("%8u %8u %10g", lights[i].first, lights[i].last, lights[i].exitance));
    if (lights.size() > MOST)
        lines.push_back(format("and %zu more", lights.size() - MOST));
    return lines;
}

}  // namespace bwfirt
