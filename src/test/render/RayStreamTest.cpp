// SPDX-License-Identifier: GPL-3.0-only
#include "render/RayStream.h"

#include "render/Renderer.h"
#include "render/Replay.h"
#include "test/Shapes.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace bwfirt {
namespace {

Scene litBox() {
    Scene scene;
    scene.triangles =
        test::joined({test::box(V3f(-2), V3f(2)), test::box(V3f(-1), V3f(1)),
                      test::quad({-1, -1, 1.9F}, {-1, 1, 1.9F}, {1, 1, 1.9F}, {1, -1, 1.9F})});
    const auto last = static_cast<std::uint32_t>(scene.triangles.size() - 1);
    scene.lights = {{last - 1, last, 10}};
    return scene;
}

Camera cornerCamera() {
    Camera camera;
    camera.position = V3d(1.8);
    camera.direction = V3d(-1);
    return camera;
}

/// Answers like another kernel, but for what a test changes.
class Altered : public RTKernel {
  public:
    explicit Altered(const RTKernel& kernel) : kernel_(kernel) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        return alterHit(kernel_.kernelIntersectGeometry(ray));
    }
    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        return alterVisible(kernel_.kernelVisibility(x, y));
    }
    std::function<std::optional<Hit>(std::optional<Hit>)> alterHit = [](auto hit) { return hit; };
    std::function<bool(bool)> alterVisible = [](bool visible) { return visible; };

  private:
    const RTKernel& kernel_;
};

class RayStreams : public testing::Test {
  protected:
    RayStreams() : scene_(litBox()), kernel_(createKernel()) {
        kernel_->kernelInitialize(scene_.triangles);
    }

    std::filesystem::path record(std::uint64_t most, int size = 16) {
        const std::filesystem::path path = folder_ / "box.rays";
        const PathTracer pathTracer(scene_, *kernel_, cornerCamera(), size, size, 1);
        RayStreamWriter stream(path, scene_.triangles, "recorder", most);
        Film film(size, size);
        counts_ = Renderer(RecordingPathTracer(pathTracer, stream), 1, 1).renderPass(film);
        stream.finish();
        return path;
    }

    test::TemporaryFolder folder_;
    Scene scene_;
    std::unique_ptr<RTKernel> kernel_;
    RayCounts counts_;
};

TEST_F(RayStreams, HoldWhatThePathTracerAskedInThisOrder) {
    const RayStream stream = readRayStream(record(1000000), scene_.triangles);
    EXPECT_EQ(stream.kernel, "recorder");
    EXPECT_EQ(stream.counts.intersect, counts_.intersect);
    EXPECT_EQ(stream.counts.visibility, counts_.visibility);
    ASSERT_EQ(stream.records.size(), counts_.intersect + counts_.visibility);

    int paths = 0, previousBounce = -1;
    for (const RayRecord& record : stream.records) {
        if (record.question == RayRecord::VISIBILITY) {
            EXPECT_EQ(record.bounce, previousBounce) << "V follows h of the same vertex";
            EXPECT_EQ(record.answer != 0, kernel_->kernelVisibility(record.a, record.b));
            continue;
        }
        EXPECT_TRUE(record.bounce == 0 || record.bounce == previousBounce + 1);
        EXPECT_EQ(record.bounce == 0, record.a == V3f(cornerCamera().position));
        previousBounce = record.bounce;
        paths += record.bounce == 0 ? 1 : 0;
        const auto hit = kernel_->kernelIntersectGeometry(record.ray());
        ASSERT_TRUE(hit && record.hit());
        EXPECT_EQ(hit->distance, record.distance);
        EXPECT_EQ(hit->triangle, record.triangle);
    }
    EXPECT_EQ(paths, 16 * 16);
}

TEST_F(RayStreams, RecordingLeavesTheImageAsItIs) {
    const PathTracer pathTracer(scene_, *kernel_, cornerCamera(), 8, 8, 1);
    RayStreamWriter stream(folder_ / "box.rays", scene_.triangles, "recorder", 10);
    Film recorded(8, 8), usual(8, 8);
    Renderer(RecordingPathTracer(pathTracer, stream), 1, 1).renderPass(recorded);
    Renderer(pathTracer, 1, 2).renderPass(usual);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            EXPECT_EQ(recorded.mean(x, y), usual.mean(x, y));
}

TEST_F(RayStreams, EndAtTheNumberThatWasAskedFor) {
    for (const std::uint64_t most : {1, 7, 100, 40000}) {
        const RayStream stream = readRayStream(record(most, 128), scene_.triangles);
        EXPECT_EQ(stream.records.size(), most);
    }
}

TEST_F(RayStreams, WithoutAnEndAreNoFile) {
    { const RayStreamWriter stream(folder_ / "box.rays", scene_.triangles, "recorder", 10); }
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / ""));
}

TEST_F(RayStreams, AreRefusedForOtherTriangles) {
    const std::filesystem::path path = record(100);
    test::Triangles others = scene_.triangles;
    std::swap(others[0], others[1]);
    EXPECT_THROW(readRayStream(path, others), std::runtime_error);
    others = scene_.triangles;
    others.pop_back();
    EXPECT_THROW(readRayStream(path, others), std::runtime_error);
}

TEST_F(RayStreams, AreRefusedWhenAnyByteIsDamagedOrMissing) {
    const std::string content = readTextFile(record(10));
    for (std::size_t i = 0; i < content.size(); ++i) {
        std::string damaged = content;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        EXPECT_THROW(readRayStream(folder_.write("damaged.rays", damaged), scene_.triangles),
                     std::runtime_error)
            << "byte " << i;
        EXPECT_THROW(
            readRayStream(folder_.write("short.rays", content.substr(0, i)), scene_.triangles),
            std::runtime_error)
            << i << " bytes";
    }
    EXPECT_THROW(readRayStream(folder_.write("long.rays", content + content), scene_.triangles),
                 std::runtime_error);
}

class Answers : public RayStreams, public testing::WithParamInterface<int> {
  protected:
    std::uint64_t count(const Altered& kernel, Difference difference) const {
        const ReplayAnswers answers = Replay(kernel, stream_, 2, 1).compareAnswers(GetParam());
        std::uint64_t others = 0;
        for (std::size_t kind = 0; kind < answers.counts.size(); ++kind)
            others += kind == static_cast<std::size_t>(difference) ? 0 : answers.counts[kind];
        EXPECT_EQ(others, 0u);
        const auto kind = static_cast<std::size_t>(difference);
        EXPECT_EQ(answers.examples[kind].size(),
                  std::min<std::size_t>(answers.counts[kind], ReplayAnswers::EXAMPLES));
        return answers.counts[kind];
    }

    RayStream stream_ = readRayStream(record(1000000), scene_.triangles);
    std::uint64_t visible_ = static_cast<std::uint64_t>(std::count_if(
        stream_.records.begin(), stream_.records.end(),
        [](const RayRecord& r) { return r.question == RayRecord::VISIBILITY && r.answer == 1; }));
};

TEST_P(Answers, OfTheRecorderAreTheRecordedOnes) {
    const ReplayAnswers answers = Replay(*kernel_, stream_, 2, 1).compareAnswers(GetParam());
    EXPECT_EQ(answers.counts, decltype(answers.counts){});
    EXPECT_EQ(answers.maxRelativeDistanceError, 0);
}

TEST_P(Answers, ThatAreWrongAreCountedByKind) {
    ASSERT_GT(visible_, 0u);
    ASSERT_LT(visible_, stream_.counts.visibility);
    Altered kernel(*kernel_);
    kernel.alterHit = [](auto) { return std::nullopt; };
    EXPECT_EQ(count(kernel, Difference::MISSED), stream_.counts.intersect);

    const auto alterTriangle = [](float factor) {
        return [factor](std::optional<Hit> hit) {
            return Hit{hit->distance * factor, hit->triangle + 1};
        };
    };
    kernel.alterHit = alterTriangle(1.001F);
    EXPECT_EQ(count(kernel, Difference::WRONG_TRIANGLE), stream_.counts.intersect);
    kernel.alterHit = alterTriangle(1.000005F);
    EXPECT_EQ(count(kernel, Difference::TIE), stream_.counts.intersect);

    kernel.alterHit = [](auto hit) { return hit; };
    kernel.alterVisible = [](bool) { return true; };
    EXPECT_EQ(count(kernel, Difference::FALSE_VISIBLE), stream_.counts.visibility - visible_);
    kernel.alterVisible = [](bool) { return false; };
    EXPECT_EQ(count(kernel, Difference::FALSE_OCCLUDED), visible_);
}

TEST_P(Answers, WhereNothingWasHitMayBeGhosts) {
    for (RayRecord& record : stream_.records)
        if (record.question == RayRecord::INTERSECT)
            record.answer = 0;
    EXPECT_EQ(count(Altered(*kernel_), Difference::GHOST), stream_.counts.intersect);
}

TEST_P(Answers, AreAsFarOffAsTheirWorstDistance) {
    Altered kernel(*kernel_);
    int asked = 0;
    kernel.alterHit = [&](std::optional<Hit> hit) {
        hit->distance *= ++asked == 5 ? 1.25F : 1.0F;
        return hit;
    };
    const ReplayAnswers answers = Replay(kernel, stream_, 1, 1).compareAnswers(GetParam());
    EXPECT_NEAR(answers.maxRelativeDistanceError, 0.25, 1e-6);
}

using Rates = Answers;

TEST_P(Rates, AreMedianMeasurementsOfTheLengthThatWasAskedFor) {
    const ReplayResult result = Replay(*kernel_, stream_, 2, GetParam(), 0.01).run();
    EXPECT_EQ(result.secondsPerMeasurement, 0.01);
    std::vector<Rate> rates = {result.intersect, result.visibility, result.mixed,
                               result.mixedInFlight};
    EXPECT_EQ(result.inFlight, GetParam());
    for (const BounceRate& bounce : result.byBounce)
        rates.push_back(bounce.mixed);
    for (const Rate& rate : rates) {
        ASSERT_EQ(rate.measurements.size(), 3u);
        std::vector<double> sorted = rate.measurements;
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(rate.perSecond, sorted[1]);
        EXPECT_GT(rate.perSecond, 0);
    }
}

TEST_P(Rates, AreMeasuredInWholeSweeps) {
    std::erase_if(stream_.records, [](const RayRecord& record) { return record.bounce > 0; });
    const auto isRay = [](const RayRecord& r) { return r.question == RayRecord::INTERSECT; };
    const std::ptrdiff_t rays =
        std::count_if(stream_.records.begin(), stream_.records.end(), isRay);
    const auto segments = static_cast<std::ptrdiff_t>(stream_.records.size()) - rays;
    ASSERT_GT(segments, 0);
    Altered kernel(*kernel_);
    std::ptrdiff_t raysAsked = 0, segmentsAsked = 0;
    kernel.alterHit = [&](auto hit) { return ++raysAsked, hit; };
    kernel.alterVisible = [&](bool visible) { return ++segmentsAsked, visible; };
    Replay(kernel, stream_, 1, GetParam(), 0.01).run();
    // One of h or V alone, three of both: warm-up and three measurements each. Then the answers,
    // in both modes.
    EXPECT_GE(raysAsked, 18 * rays);
    EXPECT_EQ(raysAsked % rays, 0);
    EXPECT_GE(segmentsAsked, 18 * segments);
    EXPECT_EQ(segmentsAsked % segments, 0);
}

INSTANTIATE_TEST_SUITE_P(InFlight, Rates, testing::Values(1, 16));

INSTANTIATE_TEST_SUITE_P(InFlight, Answers, testing::Values(1, 16));

}  // namespace
}  // namespace bwfirt
