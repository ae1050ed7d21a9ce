// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/RTKernel.h"
#include "kernel/wide-bvh/InFlight.h"
#include "kernel/wide-bvh/NearestQuery.h"
#include "kernel/wide-bvh/VisibilityQuery.h"

namespace bwfirt {

namespace {

using namespace wide;

class WideBvh : public RTKernel {
  public:
    std::string kernelDescription() const override {
        return std::string(INSTRUCTIONS) + ", " + std::to_string(WIDTH) + " children a node";
    }

    void kernelInitialize(std::span<const Triangle> triangles) override {
        tree_ = WideTree(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        if (tree_.isEmpty())
            return std::nullopt;
        return NearestQuery(tree_, ray).answer();
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        if (tree_.isEmpty())
            return true;
        return VisibilityQuery(tree_, {x, y}).answer();
    }

    // Rays in flight are spared branches by doing more work, which does not pay where each number
    // takes an instruction of its own.

    void kernelIntersectMany(std::span<const Ray> rays,
                             std::span<std::optional<Hit>> hits) const override {
        if constexpr (HAS_INSTRUCTIONS)
            askInFlight<NearestInFlight>(rays, hits, std::optional<Hit>());
        else
            RTKernel::kernelIntersectMany(rays, hits);
    }

    void kernelVisibleMany(std::span<const Segment> segments,
                           std::span<bool> visible) const override {
        if constexpr (HAS_INSTRUCTIONS)
            askInFlight<VisibilityInFlight>(segments, visible, true);
        else
            RTKernel::kernelVisibleMany(segments, visible);
    }

  private:
    template <typename Queries, typename Question, typename Answer>
    void askInFlight(std::span<const Question> questions, std::span<Answer> answers,
                     const Answer& withoutTriangles) const {
        if (tree_.isEmpty()) {
            std::fill(answers.begin(), answers.end(), withoutTriangles);
            return;
        }
        for (std::size_t begin = 0; begin < questions.size(); begin += RayBatch::SIZE) {
            const std::size_t count = std::min(questions.size() - begin, RayBatch::SIZE);
            const Queries queries(tree_, questions.subspan(begin, count));
            for (std::size_t i = 0; i < count; ++i)
                answers[begin + i] = queries.answer(i);
        }
    }

    WideTree tree_;
};

}  // namespace

std::unique_ptr<RTKernel> createKernel() {
    return std::make_unique<WideBvh>();
}

}  // namespace bwfirt
