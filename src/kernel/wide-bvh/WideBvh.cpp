// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/wide-bvh/NearestQuery.h"
#include "kernel/wide-bvh/VisibilityQuery.h"

#include <numeric>

namespace bwfirt {

namespace {

using namespace wide;

bool canBeAsked(const Ray& ray) {
    return isFinite(ray.origin) && isFinite(ray.direction) && ray.direction != V3f(0);
}

bool canBeAsked(const RTKernel::Segment& segment) {
    return canBeAsked(Ray{segment.x, segment.y - segment.x});
}

std::optional<Hit> answerWithoutTriangles(const Ray&) {
    return std::nullopt;
}
bool answerWithoutTriangles(const RTKernel::Segment&) {
    return true;
}

class WideBvh : public RTKernel {
  public:
    std::string kernelDescription() const override {
        return std::string(INSTRUCTIONS) + ", " + std::to_string(WIDTH) + " children a node";
    }

    void kernelInitialize(std::span<const Triangle> triangles) override {
        tree_ = WideTree(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        return ask<NearestQuery>(ray);
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        return ask<VisibilityQuery>({x, y});
    }

    void kernelIntersectMany(std::span<const Ray> rays,
                             std::span<std::optional<Hit>> hits) const override {
        if constexpr (IN_TURNS)
            askInTurns<NearestQuery>(rays, hits);
        else
            RTKernel::kernelIntersectMany(rays, hits);
    }

    void kernelVisibleMany(std::span<const Segment> segments,
                           std::span<bool> visible) const override {
        if constexpr (IN_TURNS)
            askInTurns<VisibilityQuery>(segments, visible);
        else
            RTKernel::kernelVisibleMany(segments, visible);
    }

  private:
    /// With narrow registers each step has branches of its own to be mispredicted, and a processor
    /// that has to guess for many rays at once guesses worse than it hides the latency of memory.
    static constexpr bool IN_TURNS = HAS_WIDE_REGISTERS;

    /// Queries that take turns: enough of them to wait for memory together.
    static constexpr std::size_t TURNS = 16;

    template <typename Query>
    typename Query::Answer ask(const typename Query::Question& question) const {
        if (tree_.isEmpty() || !canBeAsked(question))
            return answerWithoutTriangles(question);
        Query query(tree_, question);
        while (query.step()) {
        }
        return query.answer();
    }

    /// Lets queries take a step in turns, and has memory fetched for the next step of each while
    /// the others take theirs.
    template <typename Query>
    void askInTurns(std::span<const typename Query::Question> questions,
                    std::span<typename Query::Answer> answers) const {
        union Slot {
            Slot() {}  // leaves the query for later
            Query query;
        };
        std::array<Slot, TURNS> slots;
        std::array<std::size_t, TURNS> numbers;  // of their questions
        std::array<std::size_t, TURNS> order;    // the queries that are under way come first
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::size_t begun = 0;
        const auto begin = [&](std::size_t i) {
            while (begun < questions.size()) {
                const std::size_t number = begun++;
                if (!tree_.isEmpty() && canBeAsked(questions[number])) {
                    std::construct_at(&slots[i].query, tree_, questions[number]);
                    numbers[i] = number;
                    return true;
                }
                answers[number] = answerWithoutTriangles(questions[number]);
            }
            return false;
        };
        std::size_t count = 0;
        while (count < TURNS && begin(count))
            ++count;
        while (count > 0) {
            for (std::size_t turn = 0; turn < count; ++turn) {
                const std::size_t i = order[turn];
                Query& query = slots[i].query;
                if (query.step()) {
                    query.prefetch();
                    continue;
                }
                answers[numbers[i]] = query.answer();
                if (!begin(i))
                    std::swap(order[turn], order[--count]);
            }
        }
    }

    WideTree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<WideBvh>();
}

}  // namespace bwfirt
