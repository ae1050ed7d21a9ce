// SPDX-License-Identifier: GPL-3.0-only
#include "report/RunReport.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace bwfirt {
namespace {

RunReport someReport() {
    RunReport report;
    report.scene = "a scene";
    report.secondsInitialize = 0.5;
    report.secondsRender = 2;
    report.rays = {3000000, 1000000};
    report.averageIntensity = V3d(1, 2, 3);
    report.standardError = V3d(0.1);
    return report;
}

TEST(RunReport, DerivesTotalAndRate) {
    EXPECT_EQ(someReport().secondsTotal(), 2.5);
    EXPECT_EQ(someReport().raysPerSecond(), 2000000);
}

TEST(RunReport, SquaredErrorIsThatOfTheAverageAgainstTheReference) {
    RunReport report = someReport();
    EXPECT_EQ(report.squaredError(), 14) << "without a reference, against 0";
    report.referenceAverageIntensity = V3d(1, 1, 1);
    EXPECT_EQ(report.squaredError(), 5);
}

TEST(RunReport, JsonHoldsTheFigures) {
    RunReport report = someReport();
    report.kernelOptions = {{"leaf-size", "8", ""}};
    report.warnings = {"beware"};
    const nlohmann::json json = nlohmann::json::parse(reportAsJson(report));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["kernel"], "test-kernel");
    EXPECT_EQ(json["kernel_options"], (nlohmann::json{{"leaf-size", "8"}}));
    EXPECT_EQ(json["time"]["total_s"], 2.5);
    EXPECT_EQ(json["rays"]["visibility"], 1000000);
    EXPECT_EQ(json["average_intensity"], (nlohmann::json{1, 2, 3}));
    EXPECT_EQ(json["reference_average_intensity"], nullptr);
    EXPECT_EQ(json["warnings"], (nlohmann::json{"beware"}));
    EXPECT_FALSE(json.contains("view"));
}

TEST(RunReport, UnknownStandardErrorIsNull) {
    RunReport report = someReport();
    report.standardError = V3d(std::numeric_limits<double>::quiet_NaN());
    const nlohmann::json json = nlohmann::json::parse(reportAsJson(report));
    EXPECT_EQ(json["standard_error"], (nlohmann::json{nullptr, nullptr, nullptr}));
}

TEST(RunReport, TextHoldsTheSameFiguresWithUnits) {
    const std::string text = reportAsText(someReport());
    EXPECT_NE(text.find("time.render_s                   2.000 s\n"), std::string::npos) << text;
    EXPECT_NE(text.find("rays.per_second                 2.0000 million\n"), std::string::npos);
}

TEST(RunReport, BytesThatAreNotUtf8DoNotBreakIt) {
    RunReport report = someReport();
    report.scene = "\xff\xfe";
    EXPECT_TRUE(nlohmann::json::accept(reportAsJson(report)));
    EXPECT_NO_THROW(reportAsText(report));
}

}  // namespace
}  // namespace bwfirt
