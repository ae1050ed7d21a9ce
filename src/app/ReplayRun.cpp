// SPDX-License-Identifier: GPL-3.0-only
#include "app/ReplayRun.h"

#include "app/Run.h"
#include "kernel/KernelInfo.h"
#include "render/Replay.h"
#include "scene/FileIO.h"

#include <cstdio>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace bwfirt {

namespace {

/// Nine digits tell a float from all others.
std::string format(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    return text;
}

std::string format(const V3f& v) {
    return format(v.x) + " " + format(v.y) + " " + format(v.z);
}

std::string format(const std::optional<Hit>& hit) {
    return hit ? "triangle " + std::to_string(hit->triangle) + " at " + format(hit->distance)
               : "no hit";
}

std::string format(bool isVisible) {
    return isVisible ? "visible" : "occluded";
}

/// A question with the recorded answer and the kernel's own.
std::string describe(const RayStream& stream, std::uint64_t index, const RTKernel& kernel) {
    const RayRecord& record = stream.records[index];
    const bool isRay = record.question == RayRecord::INTERSECT;
    const std::string recorded = isRay ? format(record.hit()) : format(record.answer != 0);
    const std::string answer = isRay ? format(kernel.kernelIntersectGeometry(record.ray()))
                                     : format(kernel.kernelVisibility(record.a, record.b));
    return "ray " + std::to_string(index) + ", bounce " + std::to_string(record.bounce) + ": " +
           (isRay ? "h from " : "V between ") + format(record.a) + (isRay ? " along " : " and ") +
           format(record.b) + "\n    recorded by " + stream.kernel + ": " + recorded + "\n    " +
           KernelInfo::NAME + ": " + answer + "\n";
}

std::string describeExamples(const RayStream& stream, const ReplayAnswers& answers,
                             const RTKernel& kernel) {
    std::string text;
    for (std::size_t kind = 0; kind < answers.examples.size(); ++kind) {
        if (answers.counts[kind] == 0)
            continue;
        text += std::string("\n") + DIFFERENCE_NAMES[kind] + ", the first of " +
                std::to_string(answers.counts[kind]) + ":\n";
        for (const std::uint64_t index : answers.examples[kind])
            text += describe(stream, index, kernel);
    }
    return text.empty() ? text : text + "\n--replay FILE --only N asks ray N alone.\n";
}

void warnOfShortMeasurements(const ReplayResult& result, RunReport& report) {
    if (result.secondsPerMeasurement >= Replay::SECONDS_PER_MEASUREMENT)
        return;
    char text[128];
    std::snprintf(text, sizeof text,
                  "rates measured for %g s at a time are for a first look: take the default of "
                  "%g s for figures to be published",
                  result.secondsPerMeasurement, Replay::SECONDS_PER_MEASUREMENT);
    report.warnings.push_back(text);
}

void warnOfErrors(const char* what, const ReplayAnswers& answers, RunReport& report) {
    std::string errors;
    for (std::size_t kind = 0; kind < answers.counts.size(); ++kind)
        if (answers.counts[kind] > 0 && static_cast<Difference>(kind) != Difference::TIE)
            errors += (errors.empty() ? "" : ", ") + std::string(DIFFERENCE_NAMES[kind]) + " " +
                      std::to_string(answers.counts[kind]);
    if (!errors.empty())
        report.warnings.push_back(what + (" differ from the recorded ones: " + errors));
}

}  // namespace

void runReplay(const Settings& settings, std::unique_ptr<RTKernel> kernel) {
    if (!settings.report.empty())
        requireWritable(settings.report);
    Run run(settings, std::move(kernel));
    RayStream stream;
    run.report.secondsLoad +=
        secondsOf([&] { stream = readRayStream(settings.replay, run.scene().triangles); });
    if (settings.only && *settings.only >= stream.records.size())
        throw std::runtime_error(settings.replay.string() + ": has no ray " +
                                 std::to_string(*settings.only) + ", only " +
                                 std::to_string(stream.records.size()) + " rays from 0 on");
    run.initializeKernel();
    if (settings.only) {
        std::cout << describe(stream, *settings.only, run.kernel());
        return;
    }
    run.measureKernelMemory();

    RunReport& report = run.report;
    const int inFlight = settings.inFlight == 1 ? Replay::IN_FLIGHT : settings.inFlight;
    const ReplayResult result =
        Replay(run.kernel(), stream, settings.threads, inFlight, settings.secondsPerMeasurement)
            .run();
    report.rays = result.counts;
    report.secondsRender = static_cast<double>(stream.records.size()) / result.mixed.perSecond;
    constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();
    report.averageIntensity = report.standardError = V3d(UNKNOWN);
    report.replay = result;
    warnOfShortMeasurements(result, report);
    warnOfErrors("answers", result.answers, report);
    warnOfErrors("answers with many rays in flight", result.answersInFlight, report);
    const std::string examples = describeExamples(stream, result.answers, run.kernel());
    run.finish();
    std::cout << examples << std::flush;
}

}  // namespace bwfirt
