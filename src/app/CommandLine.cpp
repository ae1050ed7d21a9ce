// SPDX-License-Identifier: GPL-3.0-only
#include "app/CommandLine.h"

#include "app/viewer/Viewer.h"
#include "kernel/KernelInfo.h"
#include "report/BuildInfo.h"
#include "report/SystemInfo.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <limits>
#include <map>

namespace bwfirt {

namespace {

const std::map<std::string, View> VIEWS = {{"normals", View::NORMALS},
                                           {"triangles", View::TRIANGLES},
                                           {"distance", View::DISTANCE},
                                           {"queries", View::QUERIES}};

/// An empty path would be taken for an option that was not given.
const CLI::Validator IS_PATH(
    [](const std::string& text) { return std::string(text.empty() ? "expected a path" : ""); }, "");

constexpr int LARGEST_SIDE = 16384;
constexpr int MOST_THREADS = 1024;

/// WIDTHxHEIGHT, in pixels.
std::pair<int, int> parseSize(const std::string& text) {
    const auto side = [&](std::string_view digits) {
        int value = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        const bool isNumber = error == std::errc() && end == digits.data() + digits.size();
        if (!isNumber || value < 1 || value > LARGEST_SIDE)
            throw UsageError("--size: expected WIDTHxHEIGHT, each from 1 to " +
                             std::to_string(LARGEST_SIDE) + ", not '" + text + "'");
        return value;
    };
    const std::size_t x = text.find('x');
    const std::string_view view = text;
    return {side(view.substr(0, x)), side(x == std::string::npos ? "" : view.substr(x + 1))};
}

std::uint64_t parseSeed(const std::string& text) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size())
        throw UsageError("--seed: expected a whole number from 0 to 2^64 - 1, not '" + text + "'");
    return seed;
}

/// CLI11's ranges would let NaN pass.
double parseReplaySeconds(const std::string& text) {
    double seconds = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    const bool isNumber = error == std::errc() && end == text.data() + text.size();
    if (!isNumber || !(seconds >= 0.01 && seconds <= 3600))
        throw UsageError("--replay-seconds: expected a number from 0.01 to 3600, not '" + text +
                         "'");
    return seconds;
}

void setKernelOption(RTKernel& kernel, const std::string& assignment, Settings& settings) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos)
        throw UsageError("--kernel-option: expected NAME=VALUE, not '" + assignment + "'");
    const std::string name = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    const std::vector<KernelOption> offered = kernel.kernelOptions();
    if (std::none_of(offered.begin(), offered.end(),
                     [&](const KernelOption& option) { return option.name == name; }))
        throw UsageError(std::string("--kernel-option: ") + KernelInfo::NAME + " has no option '" +
                         name + "'");
    try {
        kernel.kernelSetOption(name, value);
    } catch (const std::invalid_argument& error) {
        throw UsageError("--kernel-option " + assignment + ": " + error.what());
    }
    settings.kernelOptions.emplace_back(name, value);
}

std::string kernelOptionsHelp(const RTKernel& kernel) {
    std::string text = std::string("Options of the kernel ") + KernelInfo::NAME + ":\n";
    const std::vector<KernelOption> options = kernel.kernelOptions();
    for (const KernelOption& option : options)
        text += "  " + option.name + "=" + option.value + "    " + option.meaning + "\n";
    return text + (options.empty() ? "  none\n" : "");
}

}  // namespace

std::optional<Settings> parseCommandLine(int argc, const char* const* argv, RTKernel& kernel) {
    const std::string program = std::string("bwfirt-") + KernelInfo::NAME;
    Settings settings;
    settings.threads = threadsAvailable();
    std::string size = "640x480";
    std::string seed = "1";
    std::string replaySeconds;
    std::vector<std::string> kernelOptions;

    CLI::App app("Benchmarks the ray tracing kernel " + std::string(KernelInfo::NAME) +
                     " inside a path tracer.",
                 program);
    app.set_version_flag("--version", program + " " + BuildInfo::VERSION + " (" +
                                          BuildInfo::COMMIT + ", " + BuildInfo::COMPILER + ")");
    app.add_option("SCENE", settings.scene, "scene file")->check(IS_PATH)->required();
    app.add_flag("--batch", settings.batch, "no window; needs --camera");
    app.add_option("--camera", settings.camera, "camera file")->check(IS_PATH)->type_name("FILE");
    app.add_option("--threads", settings.threads,
                   "threads, default: all that this process may run on")
        ->check(CLI::Range(1, MOST_THREADS))
        ->type_name("N");
    CLI::Option* passes =
        app.add_option("--passes", settings.passes,
                       "samples per pixel, default 100; the viewer goes on for ever")
            ->check(CLI::Range(1, std::numeric_limits<int>::max()))
            ->type_name("N");
    app.add_option("--size", size, "image size in pixels, default 640x480")->type_name("WxH");
    app.add_option("--seed", seed, "seed of all random numbers, default 1")->type_name("N");
    app.add_option("--output", settings.output,
                   "writes BASE.exr (linear float) and BASE.png (sRGB)")
        ->check(IS_PATH)
        ->type_name("BASE");
    app.add_option("--report", settings.report, "writes the run report as JSON")
        ->check(IS_PATH)
        ->type_name("FILE");
    app.add_option(
           "--view", settings.viewName,
           "false colours instead of light transport: normals, triangles, distance or queries")
        ->check(CLI::IsMember(VIEWS))
        ->type_name("NAME");
    app.add_option("--in-flight", settings.inFlight,
                   "paths per thread in flight, default 1: the kernel is asked ray by ray")
        ->check(CLI::Range(1, PathTracer::MAX_IN_FLIGHT))
        ->excludes("--view")
        ->type_name("N");
    CLI::Option* checkpoint =
        app.add_option("--checkpoint", settings.checkpoint,
                       "keeps the sums of all passes there, and goes on from them if it exists")
            ->check(IS_PATH)
            ->type_name("FILE");
    app.add_flag("--reference", settings.reference,
                 "writes the average intensity into the camera file as its reference")
        ->excludes("--view");
    CLI::Option* record = app.add_option("--record", settings.record,
                                         "records the rays of the path tracer and this kernel's "
                                         "answers while it renders, on one thread")
                              ->excludes("--view", "--in-flight")
                              ->excludes(checkpoint)
                              ->check(IS_PATH)
                              ->type_name("FILE");
    app.add_option("--rays", settings.raysToRecord,
                   "rendering ends with the pass in which so many are recorded, default 2000000")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->needs(record)
        ->type_name("N");
    CLI::Option* replay =
        app.add_option("--replay", settings.replay,
                       "asks the kernel the recorded rays alone: its speed without the renderer, "
                       "and a check of every answer")
            ->excludes("--view", "--output", "--reference")
            ->excludes(checkpoint, record)
            ->check(IS_PATH)
            ->type_name("FILE");
    CLI::Option* measurement =
        app.add_option("--replay-seconds", replaySeconds,
                       "the least time of each measurement of a replay, from 0.01 to 3600, "
                       "default 1")
            ->needs(replay)
            ->type_name("S");
    app.add_option("--only", settings.only,
                   "replays the N-th ray only, from 0, and prints both answers")
        ->needs(replay)
        ->type_name("N");
    app.add_option("--kernel-option", kernelOptions,
                   "sets an option of the kernel; may be repeated")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    app.footer(viewerHelp() + "\n" + kernelOptionsHelp(kernel));

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answered) {
        app.exit(answered);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what());
    }
    std::tie(settings.width, settings.height) = parseSize(size);
    settings.seed = parseSeed(seed);
    if (*measurement)
        settings.secondsPerMeasurement = parseReplaySeconds(replaySeconds);
    for (const std::string& assignment : kernelOptions)
        setKernelOption(kernel, assignment, settings);
    if (!settings.viewName.empty())
        settings.view = VIEWS.at(settings.viewName);
    if (settings.batch && settings.camera.empty() && settings.replay.empty())
        throw UsageError("--batch needs --camera FILE");
    if (!settings.batch && settings.replay.empty()) {
        for (const char* option :
             {"--output", "--report", "--checkpoint", "--record", "--reference"})
            if (app.count(option) > 0)
                throw UsageError(std::string(option) + " needs --batch");
        if (!*passes)
            settings.passes = std::numeric_limits<int>::max();
    }
    return settings;
}

}  // namespace bwfirt
