// SPDX-License-Identifier: GPL-3.0-only
#include "report/RunReport.h"

#include "kernel/KernelInfo.h"
#include "report/BuildInfo.h"
#include "report/SystemInfo.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace bwfirt {

using Json = nlohmann::ordered_json;

namespace {

/// NaN becomes null: JSON has no such number.
Json rgb(const V3d& colour) {
    return Json::array({colour.x, colour.y, colour.z});
}

Json options(const std::vector<KernelOption>& set) {
    Json object = Json::object();
    for (const KernelOption& option : set)
        object[option.name] = option.value;
    return object;
}

Json answersAsJson(const ReplayAnswers& answers) {
    Json json;
    for (std::size_t kind = 0; kind < DIFFERENCE_NAMES.size(); ++kind)
        json[DIFFERENCE_NAMES[kind]] = answers.counts[kind];
    json["max_relative_distance_error"] = answers.maxRelativeDistanceError;
    return json;
}

Json replayAsJson(const ReplayResult& replay) {
    Json bounces = Json::array();
    for (const BounceRate& bounce : replay.byBounce)
        bounces.push_back({{"first", bounce.bounces.first},
                           {"last", bounce.bounces.last},
                           {"intersect", bounce.counts.intersect},
                           {"visibility", bounce.counts.visibility},
                           {"mixed_per_second", bounce.mixed.perSecond}});
    const ReplayAnswers& answers = replay.answers;
    const auto rays = static_cast<double>(replay.counts.intersect + replay.counts.visibility);
    Json perMillion, examples;
    for (std::size_t kind = 0; kind < DIFFERENCE_NAMES.size(); ++kind) {
        const char* name = DIFFERENCE_NAMES[kind];
        perMillion[name] = static_cast<double>(answers.counts[kind]) / rays * 1e6;
        if (!answers.examples[kind].empty())
            examples[name] = answers.examples[kind];
    }
    Json json = {
        {"recorded_by", replay.recordedBy},
        {"seconds_per_measurement", replay.secondsPerMeasurement},
        {"rays",
         {{"intersect", replay.counts.intersect}, {"visibility", replay.counts.visibility}}},
        {"intersect_per_second", replay.intersect.perSecond},
        {"visibility_per_second", replay.visibility.perSecond},
        {"mixed_per_second", replay.mixed.perSecond},
        {"in_flight", replay.inFlight},
        {"mixed_in_flight_per_second", replay.mixedInFlight.perSecond},
        {"measurements",
         {{"intersect_per_second", replay.intersect.measurements},
          {"visibility_per_second", replay.visibility.measurements},
          {"mixed_per_second", replay.mixed.measurements},
          {"mixed_in_flight_per_second", replay.mixedInFlight.measurements}}},
        {"by_bounce", bounces},
        {"answers", answersAsJson(answers)},
        {"answers_in_flight", answersAsJson(replay.answersInFlight)},
        {"answers_per_million", perMillion},
        {"examples", examples.is_null() ? Json::object() : examples},
    };
    return json;
}

Json asJson(const RunReport& report) {
    const SystemInfo system = systemInfo();
    Json json = {
        {"schema", 1},
        {"program",
         {{"version", BuildInfo::VERSION},
          {"commit", BuildInfo::COMMIT},
          {"compiler", BuildInfo::COMPILER},
          {"flags", BuildInfo::FLAGS},
          {"kernel_flags", KernelInfo::FLAGS},
          {"openmp", true}}},
        {"system",
         {{"cpu", system.cpu},
          {"cores", system.cores},
          {"threads_available", system.threadsAvailable},
          {"memory_bytes", system.memoryBytes},
          {"os", system.os},
          {"date", system.date}}},
        {"kernel", KernelInfo::NAME},
        {"kernel_options", options(report.kernelOptions)},
        {"scene", report.scene},
        {"camera", report.camera},
        {"triangles", report.triangles},
        {"threads", report.threads},
        {"in_flight", report.inFlight},
        {"passes", report.passes},
        {"width", report.width},
        {"height", report.height},
        {"seed", report.seed},
        {"time",
         {{"load_s", report.secondsLoad},
          {"initialize_s", report.secondsInitialize},
          {"render_s", report.secondsRender},
          {"total_s", report.secondsTotal()}}},
        {"rays",
         {{"intersect", report.rays.intersect},
          {"visibility", report.rays.visibility},
          {"per_second", report.raysPerSecond()}}},
        {"memory",
         {{"kernel_peak_bytes", report.kernelBytesPeak},
          {"kernel_final_bytes", report.kernelBytesFinal},
          {"kernel_leaked_bytes", report.kernelBytesLeaked},
          {"process_peak_bytes", report.processBytesPeak},
          {"triangles_bytes", report.trianglesBytes}}},
        {"average_intensity", rgb(report.averageIntensity)},
        {"standard_error", rgb(report.standardError)},
        {"reference_average_intensity",
         report.referenceAverageIntensity ? rgb(*report.referenceAverageIntensity) : Json(nullptr)},
        {"squared_error", report.squaredError()},
        {"warnings", report.warnings},
    };
    if (!report.kernelDescription.empty())
        json["kernel_description"] = report.kernelDescription;
    if (!report.view.empty())
        json["view"] = report.view;
    if (report.replay)
        json["replay"] = replayAsJson(*report.replay);
    return json;
}

std::string format(const char* pattern, double value) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

/// A value with the unit that the end of its key stands for.
std::string asText(const std::string& key, const Json& value) {
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_null())
        return "unknown";
    if (key.ends_with("_s"))
        return format("%.3f s", value.get<double>());
    if (key.ends_with("_bytes"))
        return format("%.3f MB", value.get<double>() / 1e6) + " (" + value.dump() + ")";
    if (key.ends_with("per_second") && value.is_number())
        return format("%.4f million", value.get<double>() / 1e6);
    if (!value.is_array())
        return value.dump();
    std::string text;
    for (const Json& element : value) {
        if (!text.empty())
            text += ' ';
        text += asText(key, element);
    }
    return text;
}

void appendLines(std::string& text, const std::string& prefix, const Json& object) {
    constexpr std::size_t COLUMN = 32;
    for (const auto& [key, value] : object.items()) {
        std::string name = prefix + key;
        if (value.is_object()) {
            appendLines(text, name + ".", value);
            continue;
        }
        name.resize(std::max(COLUMN, name.size() + 1), ' ');
        text += name + asText(key, value) + "\n";
    }
}

}  // namespace

/// Paths may hold any bytes; those that are not UTF-8 are replaced.
std::string reportAsJson(const RunReport& report) {
    return asJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string reportAsText(const RunReport& report) {
    std::string text;
    appendLines(text, "", asJson(report));
    return text;
}

}  // namespace bwfirt
