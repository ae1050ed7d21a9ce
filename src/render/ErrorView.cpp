// SPDX-License-Identifier: GPL-3.0-only
#include "render/ErrorView.h"

#include <algorithm>

namespace bwfirt {

namespace {

/// So bright that an error still shines after as many passes without one.
constexpr double ERROR_RADIANCE = 1000;
constexpr double SHADE = 0.2;

V3d colourOf(Difference difference) {
    switch (difference) {
        case Difference::MISSED:
        case Difference::WRONG_TRIANGLE:
            return {1, 0, 0};
        case Difference::GHOST:
            return {1, 1, 0};
        case Difference::FALSE_VISIBLE:
        case Difference::FALSE_OCCLUDED:
            return {0, 1, 1};
        case Difference::TIE:
            break;
    }
    return V3d(0);
}

class Comparison : public RayListener {
  public:
    explicit Comparison(const RTKernel& reference) : reference_(reference) {}

    void intersected(const Ray& ray, int, const std::optional<Hit>& hit) override {
        note(differenceOf(reference_.kernelIntersectGeometry(ray), hit));
    }
    void connected(const V3f& x, const V3f& y, int, bool isVisible) override {
        note(differenceOf(reference_.kernelVisibility(x, y), isVisible));
    }

    V3d colour{0};
    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> counts{};

  private:
    void note(const std::optional<Difference>& difference) {
        if (!difference)
            return;
        ++counts[static_cast<std::size_t>(*difference)];
        colour += ERROR_RADIANCE * colourOf(*difference);
    }

    const RTKernel& reference_;
};

}  // namespace

void ErrorView::trace(std::span<Sample> samples, RayCounts& counts) const {
    RayCounts ofShade;
    for (Sample& sample : samples) {
        Comparison comparison(reference_);
        pathTracer_.trace({&sample, 1}, counts, comparison);
        shade_.trace({&sample, 1}, ofShade);
        sample.value = SHADE * sample.value + comparison.colour;
        for (std::size_t kind = 0; kind < differences_.size(); ++kind)
            if (comparison.counts[kind] > 0)
                differences_[kind] += comparison.counts[kind];
    }
}

std::array<std::uint64_t, DIFFERENCE_NAMES.size()> ErrorView::differences() const {
    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> counts{};
    std::copy(differences_.begin(), differences_.end(), counts.begin());
    return counts;
}

}  // namespace bwfirt
