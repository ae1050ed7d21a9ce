// SPDX-License-Identifier: GPL-3.0-only
#include "scene/Camera.h"

#include "scene/FileIO.h"
#include "scene/TextReader.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace bwfirt {

namespace {

constexpr std::string_view KEYS =
    "one of the keys type, position, direction, up, depth, filmSizeY, sensorResponse, "
    "referenceAverageIntensity";
constexpr std::array REQUIRED = {"type",  "position",  "direction",     "up",
                                 "depth", "filmSizeY", "sensorResponse"};

/// The words of one line: a key and its values.
using Line = std::vector<Word>;

Line takeLine(TextReader& text) {
    Line line = {text.take("camera", KEYS)};
    while (text.peek() && text.peek()->line == line.front().line)
        line.push_back(text.take("camera", KEYS));
    return line;
}

/// Numbers as large as float32 has them, so that no ray overflows.
template <std::size_t COUNT>
std::array<double, COUNT> numbers(const TextReader& text, const Line& line,
                                  const std::string& expected) {
    const Word& key = line.front();
    std::array<double, COUNT> values{};
    if (line.size() != COUNT + 1)
        text.fail(key.line, key.text + ": expected " + expected + ", not " +
                                std::to_string(line.size() - 1) + " values");
    for (std::size_t i = 0; i < COUNT; ++i) {
        const std::optional<double> value = parseNumber(line[i + 1].text);
        if (!value || std::abs(*value) > std::numeric_limits<float>::max())
            text.failExpected(line[i + 1], key.text, expected);
        values[i] = *value;
    }
    return values;
}

double number(const TextReader& text, const Line& line, const std::string& expected,
              bool (*isValid)(double)) {
    const double value = numbers<1>(text, line, expected)[0];
    if (!isValid(value))
        text.failExpected(line[1], line[0].text, expected);
    return value;
}

V3d vector(const TextReader& text, const Line& line, const std::string& expected) {
    const auto [x, y, z] = numbers<3>(text, line, expected);
    return {x, y, z};
}

/// The line with the parentheses around its values taken off, wherever they touch or stand alone.
Line withoutParentheses(const TextReader& text, Line line) {
    const std::string expected = "three numbers in parentheses";
    if (line.size() < 2)
        text.fail(line[0].line, line[0].text + ": expected " + expected);
    if (!line[1].text.starts_with('('))
        text.failExpected(line[1], line[0].text, expected);
    if (!line.back().text.ends_with(')'))
        text.failExpected(line.back(), line[0].text, expected);
    line[1].text.erase(0, 1);
    line.back().text.pop_back();
    std::erase_if(line, [](const Word& word) { return word.text.empty(); });
    return line;
}

bool isPositive(double value) {
    return value >= std::numeric_limits<float>::denorm_min();
}
bool isNotNegative(double value) {
    return value >= 0;
}

void setKey(const TextReader& text, const Line& line, Camera& camera) {
    const std::string& key = line.front().text;
    if (key == "type") {
        if (line.size() != 2)
            text.fail(line[0].line, "type: expected pinhole");
        if (line[1].text != "pinhole")
            text.failExpected(line[1], key, "pinhole");
    } else if (key == "position") {
        camera.position = vector(text, line, "three numbers in the range of float32");
    } else if (key == "direction") {
        camera.direction = vector(text, line, "three numbers in the range of float32");
    } else if (key == "up") {
        camera.up = vector(text, line, "three numbers in the range of float32");
    } else if (key == "depth") {
        camera.depth = number(text, line, "a number above 0 in the range of float32", isPositive);
    } else if (key == "filmSizeY") {
        camera.filmSizeY =
            number(text, line, "a number above 0 in the range of float32", isPositive);
    } else if (key == "sensorResponse") {
        camera.sensorResponse =
            number(text, line, "a number not below 0 in the range of float32", isNotNegative);
    } else if (key == "referenceAverageIntensity") {
        camera.referenceAverageIntensity =
            vector(text, withoutParentheses(text, line), "three numbers in parentheses");
    } else {
        text.failExpected(line.front(), "camera", KEYS);
    }
}

/// Nearly parallel vectors, too, leave no direction to the right of the image.
bool areParallel(const V3d& a, const V3d& b) {
    return a.normalized().cross(b.normalized()).length() < 1e-9;
}

}  // namespace

Camera readCamera(const std::filesystem::path& path) {
    TextReader text(path);
    Camera camera;
    std::map<std::string, int> lineOf;
    while (text.peek()) {
        const Line line = takeLine(text);
        const Word& key = line.front();
        if (!lineOf.emplace(key.text, key.line).second)
            text.fail(key.line, key.text + ": is given twice");
        setKey(text, line, camera);
    }
    for (const char* key : REQUIRED)
        if (!lineOf.contains(key))
            text.fail(1, std::string(key) + ": expected this key");
    if (camera.direction == V3d(0))
        text.fail(lineOf["direction"], "direction: expected a vector that is not 0");
    if (camera.up == V3d(0) || areParallel(camera.direction, camera.up))
        text.fail(lineOf["up"], "up: expected a vector that is not parallel to direction");
    return camera;
}

std::string cameraText(const Camera& camera, const std::string& comment) {
    std::string text = asComment(comment) + "type pinhole\n";
    text += "position " + formatNumbers(camera.position) + "\n";
    text += "direction " + formatNumbers(camera.direction) + "\n";
    text += "up " + formatNumbers(camera.up) + "\n";
    text += "depth " + formatNumber(camera.depth) + "\n";
    text += "filmSizeY " + formatNumber(camera.filmSizeY) + "\n";
    text += "sensorResponse " + formatNumber(camera.sensorResponse) + "\n";
    if (camera.referenceAverageIntensity)
        text += "referenceAverageIntensity (" + formatNumbers(*camera.referenceAverageIntensity) +
                ")\n";
    return text;
}

void writeCamera(const std::filesystem::path& path, const Camera& camera) {
    writeFileAtomically(path, cameraText(camera));
}

std::string referenceLine(const V3d& averageIntensity, const std::string& comment) {
    return "referenceAverageIntensity (" + formatNumbers(averageIntensity) + ")  # " + comment +
           "\n";
}

void writeReference(const std::filesystem::path& path, const std::string& line) {
    readCamera(path);
    int oldLine = 0;
    for (TextReader text(path); text.peek();)
        if (const Line words = takeLine(text); words[0].text == "referenceAverageIntensity")
            oldLine = words[0].line;

    std::istringstream old(readTextFile(path));
    std::string text, kept;
    for (int number = 1; std::getline(old, kept); ++number)
        text += number == oldLine ? line : kept + "\n";
    writeFileAtomically(path, oldLine > 0 ? text : text + line);
}

}  // namespace bwfirt
