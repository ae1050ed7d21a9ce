// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Scene.h"

#include "scene/FileIO.h"
#include "scene/LightSampler.h"
#include "scene/TextReader.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace bwfirt {

namespace {

constexpr std::string_view KEYS = "one of the keys triangles, lights, reflectance";

/// The numbers of a light as they stand in the file, to be checked once the triangles are known.
struct LightEntry {
    int line = 0;
    std::int64_t first = 0;
    std::int64_t last = 0;
    double exitance = 0;
};

std::vector<LightEntry> readLightEntries(TextReader& text, int line) {
    const std::int64_t count = text.takeInteger("lights", "the number of lights");
    if (count < 0)
        text.fail(line,
                  "lights: expected a count that is not negative, not " + std::to_string(count));
    std::vector<LightEntry> entries;
    for (std::int64_t i = 0; i < count; ++i) {
        LightEntry entry;
        entry.line = text.peek() ? text.peek()->line : 0;
        entry.first = text.takeInteger("lights", "the index of a light's first triangle");
        entry.last = text.takeInteger("lights", "the index of a light's last triangle");
        entry.exitance = text.takeNumber("lights", "a light's radiant exitance, a finite number");
        entries.push_back(entry);
    }
    return entries;
}

Light checkedLight(const TextReader& text, const LightEntry& entry,
                   const std::vector<Triangle>& triangles) {
    const auto fail = [&](const std::string& what) { text.fail(entry.line, "lights: " + what); };
    const std::string range =
        "light " + std::to_string(entry.first) + " " + std::to_string(entry.last);
    if (entry.first < 0 || entry.last < 0)
        fail(range + ": a triangle index is negative");
    if (entry.first > entry.last)
        fail(range + ": the first triangle comes after the last");
    if (static_cast<std::uint64_t>(entry.last) >= triangles.size())
        fail(range + ": the last triangle of the scene is " + std::to_string(triangles.size() - 1));
    if (entry.exitance < 0)
        fail(range + ": the radiant exitance is negative");
    if (std::none_of(triangles.begin() + entry.first, triangles.begin() + entry.last + 1, hasArea))
        fail(range + ": its triangles have no area");
    return {static_cast<std::uint32_t>(entry.first), static_cast<std::uint32_t>(entry.last),
            entry.exitance};
}

void checkLightsTogether(const TextReader& text, std::vector<LightEntry> entries,
                         const Scene& scene) {
    if (entries.empty())
        return;
    const double power = LightSampler(scene).totalPower();
    if (!(power > 0 && std::isfinite(power)))
        text.fail(entries.front().line,
                  "lights: expected a radiant exitance above 0 for at least one light, but all "
                  "lights together have a power of " +
                      formatNumber(power));
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < entries.size(); ++i) {
        if (entries[i].first <= entries[i - 1].last)
            text.fail(
                std::max(entries[i].line, entries[i - 1].line),
                "lights: triangle " + std::to_string(entries[i].first) + " belongs to two lights");
    }
}

/// @throws std::runtime_error where no word of a scene file can hold the path
std::string quotedIfNeeded(const std::string& path) {
    if (path.empty() || path.find_first_of("\"\n") != std::string::npos)
        throw std::runtime_error("a scene file cannot hold the path '" + path + "'");
    return path.find_first_of(" \t\r\v\f#") == std::string::npos ? path : '"' + path + '"';
}

}  // namespace

Scene readScene(const std::filesystem::path& path) {
    TextReader text(path);
    Scene scene;
    std::vector<LightEntry> entries;
    std::set<std::string> seen;
    while (text.peek()) {
        const Word key = text.take("", KEYS);
        if (!seen.insert(key.text).second)
            text.fail(key.line, key.text + ": is given twice");
        if (key.text == "triangles") {
            scene.trianglesPath = text.take("triangles", "the path of a triangle file").text;
        } else if (key.text == "lights") {
            entries = readLightEntries(text, key.line);
        } else if (key.text == "reflectance") {
            scene.reflectance = text.takeNumber("reflectance", "a number in [0, 1)");
            if (!(scene.reflectance >= 0 && scene.reflectance < 1))
                text.fail(key.line, "reflectance: expected a number in [0, 1), not " +
                                        formatNumber(scene.reflectance));
        } else {
            text.failExpected(key, "scene", KEYS);
        }
    }
    if (!seen.contains("triangles"))
        text.fail(1, "triangles: expected this key with the path of a triangle file");

    scene.triangles = readTriangles(path.parent_path() / scene.trianglesPath);
    for (const LightEntry& entry : entries)
        scene.lights.push_back(checkedLight(text, entry, scene.triangles));
    checkLightsTogether(text, entries, scene);
    return scene;
}

void writeScene(const std::filesystem::path& path, const Scene& scene) {
    std::string text = "triangles " + quotedIfNeeded(scene.trianglesPath) + "\n";
    text += "lights " + std::to_string(scene.lights.size());
    const bool one = scene.lights.size() == 1;
    for (const Light& light : scene.lights)
        text += (one ? " " : "\n    ") + std::to_string(light.first) + " " +
                std::to_string(light.last) + " " + formatNumber(light.exitance);
    text += "\nreflectance " + formatNumber(scene.reflectance) + "\n";
    writeFileAtomically(path, text);
}

}  // namespace bwfirt
