// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Sampling.h"
#include "scene/Scene.h"

#include <cstddef>
#include <vector>

namespace bwfirt {

/// A point on a light, chosen at random.
struct LightSample {
    V3d point;
    V3d normal;       ///< of the triangle, unit length; the light emits to both sides
    double radiance;  ///< exitance / pi
    double pdfArea;   ///< density with which the point was chosen, per area
};

/// Chooses points on the lights in proportion to the power that they emit: a triangle with
/// probability area * exitance / total, then a point uniform in its area. Triangles without area
/// are never chosen. Immutable, so that all threads may share it.
class LightSampler {
  public:
    explicit LightSampler(const Scene& scene);

    /// Sum of area * exitance over all triangles of all lights, of one side.
    double totalPower() const { return emitters_.empty() ? 0 : emitters_.back().cumulativePower; }

    /// Must not be called where the total power is 0.
    LightSample sample(Random& random) const {
        const double target = random.uniform() * totalPower();
        // The first emitter beyond the target. Which half it is in cannot be predicted, hence a
        // factor instead of a branch.
        const Emitter* found = emitters_.data();
        for (std::size_t count = emitters_.size(); count > 1; count -= count / 2)
            found += (found[count / 2 - 1].cumulativePower <= target) * (count / 2);
        return {sampleTriangle(found->a, found->b, found->c, random), found->normal,
                found->radiance, found->pdfArea};
    }

    /// The radiance that the triangle emits, 0 where it is no light.
    double radiance(std::uint32_t triangle) const;

  private:
    struct Emitter {
        double cumulativePower;  ///< of this and all emitters before it
        V3d a, b, c;
        V3d normal;
        double radiance;
        double pdfArea;
    };

    std::vector<Emitter> emitters_;
    std::vector<Light> lights_;  ///< in the order of their triangles
};

}  // namespace bwfirt
