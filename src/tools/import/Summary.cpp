// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Summary.h"

#include "scene/TextReader.h"
#include "tools/import/Model.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace bwfirt {

namespace {

constexpr std::size_t MOST_LINES = 10;  // of lights, or of complaints

/// Three significant digits, whatever the locale.
std::string rounded(double value) {
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                      std::chars_format::general, 3);
    return {buffer.data(), result.ptr};
}

std::string rounded(const V3d& v, const std::string& separator) {
    return rounded(v.x) + separator + rounded(v.y) + separator + rounded(v.z);
}

std::string line(const std::string& key, const std::string& value) {
    return key + std::string(13 - key.size(), ' ') + value + "\n";
}

/// A line each, but a count of those that are too many.
std::string lines(const std::string& key, const std::vector<std::string>& values) {
    std::string text;
    for (std::size_t i = 0; i < std::min(values.size(), MOST_LINES); ++i)
        text += line(i == 0 ? key : "", values[i]);
    if (values.size() > MOST_LINES)
        text += line("", "and " + std::to_string(values.size() - MOST_LINES) + " more");
    return text;
}

/// A light above the model that lights its top about as brightly as white.
std::string exampleLight(const Conversion& conversion) {
    const Imath::Box3d& box = conversion.modelBox;
    const V3d size = box.size();
    const double largest = std::max({size.x, size.y, size.z});
    const V3d centre =
        box.center() + (std::abs(size.dot(conversion.up)) + largest) / 2 * conversion.up;
    return "--light " + rounded(centre, ",") + "," + rounded(largest / 2) + ",20";
}

std::string lightLines(const Conversion& conversion) {
    const std::vector<Light>& lights = conversion.scene.lights;
    if (lights.empty())
        return line("lights",
                    "none, and batch runs need one. To add one, import again, for "
                    "example with") +
               line("", exampleLight(conversion)) +
               line("",
                    "or open the scene in the viewer: l for light mode, click triangles, "
                    "Ctrl+S");
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < lights.size(); ++i)
        texts.push_back("triangles " + std::to_string(lights[i].first) + " to " +
                        std::to_string(lights[i].last) + ", exitance " +
                        rounded(lights[i].exitance) + ", " + conversion.lightNames[i]);
    return lines("lights", texts);
}

std::string triangleLine(const std::vector<Triangle>& triangles) {
    const auto flat = std::count_if(triangles.begin(), triangles.end(),
                                    [](const Triangle& triangle) { return !hasArea(triangle); });
    return line("triangles", std::to_string(triangles.size()) +
                                 (flat > 0 ? ", of which " + std::to_string(flat) +
                                                 " have no area and are never hit"
                                           : ""));
}

std::string placementLine(const Conversion& conversion) {
    float largest = 0;
    for (const Triangle& triangle : conversion.scene.triangles)
        for (const V3f& v : triangle.vertices)
            largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return line("coordinates",
                formula(conversion.placement) + ", the largest is " + rounded(largest));
}

/// What the file holds and a scene cannot.
std::string skippedLines(const Model& model) {
    std::vector<std::string> texts;
    if (const std::size_t count = model.pointsAndLines(); count > 0)
        texts.push_back(std::to_string(count) + " points and lines");
    if (const std::size_t count = model.lightSources(); count > 0)
        texts.push_back(std::to_string(count) + " lights that are no surface of the model");
    for (const Material& material : model.materials())
        if (material.hasTexture)
            texts.push_back("the emissive texture of material '" + printable(material.name) +
                            "', which is no light");
    return lines("skipped", texts);
}

}  // namespace

std::string summary(const Model& model, const Conversion& conversion) {
    const std::string camera =
        conversion.hasCameraOfFile
            ? "the first one of the file"
            : "frames the model from outside; of a closed room it sees walls";
    return line("format", printable(model.format())) + triangleLine(conversion.scene.triangles) +
           placementLine(conversion) + lightLines(conversion) +
           line("camera", camera + ", at " + rounded(conversion.camera.position, " ")) +
           skippedLines(model) + lines("assimp says", model.complaints());
}

}  // namespace bwfirt
