// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Settings.h"

#include "report/BuildInfo.h"
#include "scene/TextReader.h"

#include <CLI/CLI.hpp>

#include <array>
#include <limits>
#include <map>

namespace bwfirt {

namespace {

const std::map<std::string, V3d> AXES = {{"x", V3d(1, 0, 0)},   {"y", V3d(0, 1, 0)},
                                         {"z", V3d(0, 0, 1)},   {"-x", V3d(-1, 0, 0)},
                                         {"-y", V3d(0, -1, 0)}, {"-z", V3d(0, 0, -1)}};

/// A finite number that float32 can hold.
std::optional<double> number(const std::string& text) {
    const std::optional<double> value = parseNumber(text);
    return value && std::abs(*value) <= std::numeric_limits<float>::max() ? value : std::nullopt;
}

double parseScale(const std::string& text) {
    const std::optional<double> scale = number(text);
    if (!scale || *scale <= 0)
        throw ImportUsageError("--scale: expected a number above 0, not '" + text + "'");
    return *scale;
}

SquareLight parseLight(const std::string& text) {
    std::array<double, 5> values{};
    const std::vector<std::string> words = CLI::detail::split(text, ',');
    bool isValid = words.size() == values.size();
    for (std::size_t i = 0; isValid && i < values.size(); ++i) {
        const std::optional<double> value = number(words[i]);
        isValid = value && (i < 3 || *value > 0);
        values[i] = value.value_or(0);
    }
    if (!isValid)
        throw ImportUsageError(
            "--light: expected x,y,z,size,exitance, five numbers with size and exitance above 0, "
            "not '" +
            text + "'");
    return {{values[0], values[1], values[2]}, values[3], values[4]};
}

std::string notEmpty(const std::string& path) {
    return path.empty() ? "expected a path" : "";
}

std::string baseName(const std::string& path) {
    return std::filesystem::path(path).filename().empty() ? "expected a path with a name at its end"
                                                          : "";
}

}  // namespace

std::optional<ImportSettings> parseImportCommandLine(int argc, const char* const* argv) {
    ImportSettings settings;
    std::string scale, up;
    std::vector<std::string> lights;
    CLI::App app(
        "Turns a model of any format that assimp reads (OBJ, PLY, STL, glTF, FBX, Collada, "
        "...) into a scene: BASE.ra2, BASE.camera and BASE.scene.",
        "bwfirt-import");
    app.set_version_flag("--version", std::string("bwfirt-import ") + BuildInfo::VERSION + " (" +
                                          BuildInfo::COMMIT + ", " + BuildInfo::COMPILER + ")");
    app.add_option("MODEL", settings.model, "model file")
        ->check(CLI::Validator(notEmpty, ""))
        ->required();
    app.add_option("-o,--output", settings.base, "where the scene goes")
        ->check(CLI::Validator(baseName, ""))
        ->type_name("BASE")
        ->required();
    CLI::Option* scaleOption =
        app.add_option("--scale", scale,
                       "factor on all coordinates; the default is a power of two that brings the "
                       "largest to between 50 and 100, with far models moved to the origin first")
            ->type_name("F");
    app.add_option(
           "--up", up,
           "the model's up axis, for the camera and --light: x, y, z, -x, -y or -z; default "
           "what the file tells, or y")
        ->check(CLI::IsMember(AXES))
        ->type_name("AXIS");
    app.add_option("--light", lights,
                   "adds a square light, perpendicular to up, in the model's coordinates; may be "
                   "repeated")
        ->type_name("x,y,z,size,exitance")
        ->allow_extra_args(false);
    app.footer(
        "A file's emissive materials become lights. Without any, and without --light, the "
        "scene has none, which batch runs refuse.\n");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answered) {
        app.exit(answered);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw ImportUsageError(error.what());
    }
    if (scaleOption->count() > 0)
        settings.scale = parseScale(scale);
    if (!up.empty())
        settings.up = AXES.at(up);
    for (const std::string& light : lights)
        settings.lights.push_back(parseLight(light));
    return settings;
}

}  // namespace bwfirt
