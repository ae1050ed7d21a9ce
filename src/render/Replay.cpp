// SPDX-License-Identifier: GPL-3.0-only
#include "render/Replay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

namespace bwfirt {

namespace {

constexpr int MEASUREMENTS = 3;

/// Questions that a thread takes at a time: enough of them to outweigh the taking.
constexpr std::size_t CHUNK = 4096;

constexpr std::array<Bounces, 5> BOUNCES = {
    {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, std::numeric_limits<std::uint16_t>::max()}}};

/// A measurement takes whole sweeps of all `count` questions: calls ask(begin, end) for chunks of
/// them, which the threads share.
template <typename Ask>
Rate measure(std::size_t count, int threads, double secondsAtLeast, const Ask& ask) {
    using Clock = std::chrono::steady_clock;
    const auto sweep = [&] {
#pragma omp parallel for schedule(dynamic) num_threads(threads)
        for (std::size_t begin = 0; begin < count; begin += CHUNK)
            ask(begin, std::min(begin + CHUNK, count));
    };
    Rate rate;
    if (count == 0)
        return rate;
    sweep();  // to warm up
    for (int i = 0; i < MEASUREMENTS; ++i) {
        std::size_t sweeps = 0;
        double seconds = 0;
        const Clock::time_point start = Clock::now();
        do {
            sweep();
            ++sweeps;
            seconds = std::chrono::duration<double>(Clock::now() - start).count();
        } while (seconds < secondsAtLeast);
        rate.measurements.push_back(static_cast<double>(count * sweeps) / seconds);
    }
    std::vector<double> sorted = rate.measurements;
    std::sort(sorted.begin(), sorted.end());
    rate.perSecond = sorted[sorted.size() / 2];
    return rate;
}

/// The same questions apart, and how many of them are among the first records.
struct Questions {
    explicit Questions(std::span<const RayRecord> records) : mixed(records) {
        for (const RayRecord& record : records) {
            before.push_back({rays.size(), segments.size()});
            if (record.question == RayRecord::INTERSECT) {
                placeOfRay.push_back(before.size() - 1);
                rays.push_back(record.ray());
            } else {
                segments.push_back({record.a, record.b});
            }
        }
        before.push_back({rays.size(), segments.size()});
    }

    std::span<const RayRecord> mixed;
    std::vector<Ray> rays;
    std::vector<RTKernel::Segment> segments;
    std::vector<RayCounts> before;        ///< each of `mixed`, and its end
    std::vector<std::size_t> placeOfRay;  ///< of each ray in `mixed`
};

/// Asks the questions from `begin` to `end`, one by one, and forgets the answers.
class OneByOne {
  public:
    OneByOne(const RTKernel& kernel, const Questions& questions)
        : kernel_(kernel), questions_(questions) {}

    void intersect(std::size_t begin, std::size_t end) const {
        for (std::size_t i = begin; i < end; ++i)
            kernel_.kernelIntersectGeometry(questions_.rays[i]);
    }

    void visibility(std::size_t begin, std::size_t end) const {
        for (std::size_t i = begin; i < end; ++i)
            kernel_.kernelVisibility(questions_.segments[i].x, questions_.segments[i].y);
    }

    void mixed(std::size_t begin, std::size_t end) const {
        for (const RayRecord& record : questions_.mixed.subspan(begin, end - begin)) {
            if (record.question == RayRecord::INTERSECT)
                kernel_.kernelIntersectGeometry(record.ray());
            else
                kernel_.kernelVisibility(record.a, record.b);
        }
    }

  private:
    const RTKernel& kernel_;
    const Questions& questions_;
};

/// Asks them many at a time.
class InFlight {
  public:
    InFlight(const RTKernel& kernel, const Questions& questions, int inFlight)
        : kernel_(kernel), questions_(questions), size_(static_cast<std::size_t>(inFlight)) {}

    /// As the renderer asks: of so many paths first h, then the questions V between those.
    void mixed(std::size_t begin, std::size_t end) const {
        const std::span rays(questions_.rays);
        const std::span segments(questions_.segments);
        std::vector<std::optional<Hit>> hits(size_);
        const auto visible = std::make_unique<bool[]>(size_);
        const std::size_t lastRay = questions_.before[end].intersect;
        for (std::size_t i = begin; i < end;) {
            auto [ray, segment] = questions_.before[i];
            const std::size_t count = std::min(size_, lastRay - ray);
            kernel_.kernelIntersectMany(rays.subspan(ray, count), std::span(hits).first(count));
            ray += count;
            i = ray < lastRay ? questions_.placeOfRay[ray] : end;
            while (segment < questions_.before[i].visibility) {
                const std::size_t among =
                    std::min<std::size_t>(size_, questions_.before[i].visibility - segment);
                kernel_.kernelVisibleMany(segments.subspan(segment, among), {visible.get(), among});
                segment += among;
            }
        }
    }

  private:
    const RTKernel& kernel_;
    const Questions& questions_;
    std::size_t size_;
};

}  // namespace

ReplayAnswers Replay::compareAnswers(int inFlight) const {
    const Questions questions(stream_.records);
    const std::span rays(questions.rays);
    const std::span segments(questions.segments);
    std::vector<std::optional<Hit>> hits(rays.size());
    const auto visible = std::make_unique<bool[]>(segments.size());
    if (inFlight == 1) {
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits[i] = kernel_.kernelIntersectGeometry(rays[i]);
        for (std::size_t i = 0; i < segments.size(); ++i)
            visible[i] = kernel_.kernelVisibility(segments[i].x, segments[i].y);
    } else {
        const auto size = static_cast<std::size_t>(inFlight);
        for (std::size_t i = 0; i < rays.size(); i += size) {
            const std::size_t count = std::min(size, rays.size() - i);
            kernel_.kernelIntersectMany(rays.subspan(i, count), {hits.data() + i, count});
        }
        for (std::size_t i = 0; i < segments.size(); i += size) {
            const std::size_t count = std::min(size, segments.size() - i);
            kernel_.kernelVisibleMany(segments.subspan(i, count), {visible.get() + i, count});
        }
    }

    ReplayAnswers answers;
    for (std::size_t i = 0; i < questions.mixed.size(); ++i) {
        const RayRecord& record = questions.mixed[i];
        const auto [ray, segment] = questions.before[i];
        std::optional<Difference> difference;
        if (record.question == RayRecord::INTERSECT) {
            const std::optional<Hit>& hit = hits[ray];
            difference = differenceOf(record.hit(), hit);
            if (hit && record.hit() && hit->triangle == record.triangle) {
                const double recorded = record.distance;
                answers.maxRelativeDistanceError =
                    std::max(answers.maxRelativeDistanceError,
                             std::abs(hit->distance - recorded) / recorded);
            }
        } else {
            difference = differenceOf(record.answer != 0, visible[segment]);
        }
        if (!difference)
            continue;
        const auto kind = static_cast<std::size_t>(*difference);
        ++answers.counts[kind];
        if (answers.examples[kind].size() < ReplayAnswers::EXAMPLES)
            answers.examples[kind].push_back(i);
    }
    return answers;
}

ReplayResult Replay::run() const {
    ReplayResult result;
    result.recordedBy = stream_.kernel;
    result.secondsPerMeasurement = secondsPerMeasurement_;
    result.counts = stream_.counts;
    {
        const Questions all(stream_.records);
        const OneByOne oneByOne(kernel_, all);
        const InFlight inFlight(kernel_, all, inFlight_);
        result.intersect = measure(all.rays.size(), threads_, secondsPerMeasurement_,
                                   [&](auto begin, auto end) { oneByOne.intersect(begin, end); });
        result.visibility = measure(all.segments.size(), threads_, secondsPerMeasurement_,
                                    [&](auto begin, auto end) { oneByOne.visibility(begin, end); });
        result.mixed = measure(all.mixed.size(), threads_, secondsPerMeasurement_,
                               [&](auto begin, auto end) { oneByOne.mixed(begin, end); });
        result.inFlight = inFlight_;
        result.mixedInFlight = measure(all.mixed.size(), threads_, secondsPerMeasurement_,
                                       [&](auto begin, auto end) { inFlight.mixed(begin, end); });
    }
    for (const Bounces& bounces : BOUNCES) {
        std::vector<RayRecord> records;
        std::copy_if(stream_.records.begin(), stream_.records.end(), std::back_inserter(records),
                     [&](const RayRecord& record) {
                         return record.bounce >= bounces.first && record.bounce <= bounces.last;
                     });
        const Questions some(records);
        const OneByOne asker(kernel_, some);
        result.byBounce.push_back(
            {bounces,
             {some.rays.size(), some.segments.size()},
             measure(records.size(), threads_, secondsPerMeasurement_,
                     [&](auto begin, auto end) { asker.mixed(begin, end); })});
    }
    result.answers = compareAnswers(1);
    result.answersInFlight = compareAnswers(inFlight_);
    return result;
}

}  // namespace bwfirt
