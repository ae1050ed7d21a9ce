// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/LightEditor.h"

#include "scene/TextReader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bwfirt {

namespace {

constexpr double FIRST_EXITANCE = 100;
constexpr double LEAST_EXITANCE = 1e-6;
constexpr double MOST_EXITANCE = 1e12;

/// The number of this index in the series R10; 0 is 1, ten more are ten times as much.
double preferredNumber(int index) {
    constexpr std::array SERIES = {"1", "1.25", "1.6", "2", "2.5", "3.15", "4", "5", "6.3", "8"};
    const int decade = static_cast<int>(std::floor(index / 10.0));
    const char* digits = SERIES[static_cast<std::size_t>(index - 10 * decade)];
    return *parseNumber(std::string(digits) + "e" + std::to_string(decade));
}

double nextExitance(double exitance, int step) {
    const double value = std::clamp(exitance, LEAST_EXITANCE, MOST_EXITANCE);
    int index = static_cast<int>(std::lround(10 * std::log10(value))) - step;
    while (step > 0 ? preferredNumber(index) <= value : preferredNumber(index) >= value)
        index += step;
    return std::clamp(preferredNumber(index), LEAST_EXITANCE, MOST_EXITANCE);
}

}  // namespace

LightEditor::LightEditor(std::span<const Triangle> triangles, std::vector<Light> lights)
    : triangles_(triangles), state_{std::move(lights), FIRST_EXITANCE, {}}, saved_(state_.lights) {
    if (!saved_.empty())
        state_.exitance = saved_.back().exitance;
}

void LightEditor::toggle(std::uint32_t triangle) {
    remember();
    state_.picked = triangle;
    const auto light = lightOf(triangle);
    if (light == state_.lights.end())
        add(triangle);
    else
        remove(light, triangle);
    std::sort(state_.lights.begin(), state_.lights.end(),
              [](const Light& a, const Light& b) { return a.first < b.first; });
}

void LightEditor::add(std::uint32_t triangle) {
    std::vector<Light>& lights = state_.lights;
    Light added{triangle, triangle, state_.exitance};
    const auto before = triangle > 0 ? lightOf(triangle - 1) : lights.end();
    if (before != lights.end()) {
        added.first = before->first;
        added.exitance = before->exitance;
        lights.erase(before);
    }
    const auto after = lightOf(triangle + 1);
    const bool isAlone = added.first == triangle;
    if (after != lights.end() && (isAlone || after->exitance == added.exitance)) {
        added.last = after->last;
        added.exitance = after->exitance;
        lights.erase(after);
    }
    state_.exitance = added.exitance;
    lights.push_back(added);
}

void LightEditor::remove(std::vector<Light>::iterator light, std::uint32_t triangle) {
    const Light whole = *light;
    state_.lights.erase(light);
    const auto keep = [&](std::uint32_t begin, std::uint32_t end) {
        if (std::any_of(triangles_.begin() + begin, triangles_.begin() + end, hasArea))
            state_.lights.push_back({begin, end - 1, whole.exitance});
    };
    keep(whole.first, triangle);
    keep(triangle + 1, whole.last + 1);
}

void LightEditor::changeExitance(int steps) {
    remember();
    const int step = steps > 0 ? 1 : -1;
    const auto change = [&](double& exitance) {
        for (int i = 0; i != steps; i += step)
            exitance = nextExitance(exitance, step);
    };
    const auto picked = state_.picked ? lightOf(*state_.picked) : state_.lights.end();
    if (picked != state_.lights.end()) {
        change(picked->exitance);
        state_.exitance = picked->exitance;
        return;
    }
    for (Light& light : state_.lights)
        change(light.exitance);
    change(state_.exitance);
}

bool LightEditor::undo() {
    if (history_.empty())
        return false;
    state_ = std::move(history_.back());
    history_.pop_back();
    return true;
}

void LightEditor::remember() {
    history_.push_back(state_);
}

std::vector<Light>::iterator LightEditor::lightOf(std::uint32_t triangle) {
    return std::find_if(state_.lights.begin(), state_.lights.end(), [&](const Light& light) {
        return light.first <= triangle && triangle <= light.last;
    });
}

}  // namespace bwfirt
