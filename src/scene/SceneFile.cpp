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

[[noreturn]] void failLight(const TextReader& text, const LightEntry& entry,
                            const std::string& what) {
    text.fail(entry.line, "lights: light " + std::to_string(entry.first) + " " +
                              std::to_string(entry.last) + ": " + what);
}

Light checkedLight(const TextReader& text, const LightEntry& entry, std::size_t triangles) {
    const auto fail = [&](const std::string& what) { failLight(text, entry, what); };
    if (entry.first < 0 || entry.last < 0)
        fail("a triangle index is negative");
    if (entry.first > entry.last)
        fail("the first triangle comes after the last");
    if (static_cast<std::uint64_t>(entry.last) >= triangles)
        fail("the last triangle of the scene is " + std::to_string(triangles - 1));
    if (entry.exitance < 0)
        fail("the radiant exitance is negative");
    return {static_cast<std::uint32_t>(entry.first), static_cast<std::uint32_t>(entry.last),
            entry.exitance};
}

/// What can be said only once all lights are known to be ranges of triangles. Overlaps come first:
/// without them what follows looks at each triangle once, however many lights a file lists.
void checkLightsTogether(const TextReader& text, const std::vector<LightEntry>& entries,
                         const Scene& scene) {
    if (entries.empty())
        return;
    std::vector<LightEntry> sorted = entries;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first <= sorted[i - 1].last)
            text.fail(
                std::max(sorted[i].line, sorted[i - 1].line),
                "lights: triangle " + std::to_string(sorted[i].first) + " belongs to two lights");

    const auto& triangles = scene.triangles;
    for (const LightEntry& entry : entries)
        if (std::none_of(triangles.begin() + entry.first, triangles.begin() + entry.last + 1,
                         hasArea))
            failLight(text, entry, "its triangles have no area");
    const double power = LightSampler(scene).totalPower();
    if (!(power > 0 && std::isfinite(power)))
        text.fail(entries.front().line,
                  "lights: expected a radiant exitance above 0 for at least one light, but all "
                  "lights together have a power of " +
                      formatNumber(power));
}

/// A path is part of messages, and a zero byte would end it early for the operating system.
bool hasControlCharacters(const std::string& path) {
    return std::any_of(path.begin(), path.end(),
                       [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

/// The path as a word of a scene file, in quotes where it needs them.
/// @throws std::runtime_error where no word can hold it
std::string wordOf(const std::string& path) {
    const bool isWord = !path.starts_with('"') && path.find_first_of(" #") == std::string::npos;
    if (path.empty() || hasControlCharacters(path) ||
        (!isWord && path.find('"') != std::string::npos))
        throw std::runtime_error("a scene file cannot hold the path '" + printable(path) + "'");
    return isWord ? path : '"' + path + '"';
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
            const std::string expected = "the path of a triangle file";
            const Word word = text.take("triangles", expected);
            if (hasControlCharacters(word.text))
                text.failExpected(word, "triangles", expected + " without control characters");
            scene.trianglesPath = word.text;
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
        scene.lights.push_back(checkedLight(text, entry, scene.triangles.size()));
    checkLightsTogether(text, entries, scene);
    return scene;
}

std::string lightsText(const std::vector<Light>& lights) {
    std::string text = "lights " + std::to_string(lights.size());
    for (const Light& light : lights)
        text += (lights.size() == 1 ? " " : "\n    ") + std::to_string(light.first) + " " +
                std::to_string(light.last) + " " + formatNumber(light.exitance);
    return text;
}

void writeScene(const std::filesystem::path& path, const Scene& scene, const std::string& comment) {
    writeFileAtomically(path, asComment(comment) + "triangles " + wordOf(scene.trianglesPath) +
                                  "\n" + lightsText(scene.lights) + "\nreflectance " +
                                  formatNumber(scene.reflectance) + "\n");
}

void writeLights(const std::filesystem::path& path, const std::vector<Light>& lights) {
    std::string content = readTextFile(path);
    TextReader text(path);
    std::size_t begin = content.size(), end = begin;
    while (text.peek()) {
        const Word key = text.take("", KEYS);
        if (key.text != "lights") {
            text.take(key.text, "its value");
            continue;
        }
        readLightEntries(text, key.line);
        begin = key.begin;
        end = text.endOfLastWord();
    }
    std::string replacement = lightsText(lights);
    if (begin == content.size())
        replacement = (content.ends_with('\n') ? "" : "\n") + replacement + "\n";
    writeFileAtomically(path, content.replace(begin, end - begin, replacement));
}

}  // namespace bwfirt
