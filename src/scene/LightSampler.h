// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

#include <cstddef>
#include <vector>

namespace bwfirt {

/// A triangle that emits to both sides.
struct Emitter {
    V3d a, ab, bc;    ///< the first vertex, and the edges from there to the last one
    V3d normal;       ///< of unit length
    double radiance;  ///< exitance / pi
    double pdfArea;   ///< density, per area, of its points among those of all lights
};

/// Chooses triangles of the lights in proportion to the power that they emit: area * exitance.
/// Triangles without area are never chosen. Immutable, so that all threads may share it.
class LightSampler {
  public:
    explicit LightSampler(const Scene& scene);

    /// Sum of area * exitance over all triangles of all lights, of one side.
    double totalPower() const { return powers_.empty() ? 0 : powers_.back(); }

    /// The triangle to which the random number u in [0, 1) belongs. Must not be called where the
    /// total power is 0.
    const Emitter& choose(double u) const {
        const double target = u * powers_.back();
        // The first emitter beyond the target. Which half it is in cannot be predicted, hence a
        // factor instead of a branch.
        const double* found = powers_.data();
        for (std::size_t count = powers_.size(); count > 1; count -= count / 2)
            found += (found[count / 2 - 1] <= target) * (count / 2);
        return emitters_[static_cast<std::size_t>(found - powers_.data())];
    }

    /// The radiance that the triangle emits, 0 where it is no light.
    double radiance(std::uint32_t triangle) const;

  private:
    std::vector<Emitter> emitters_;
    std::vector<double> powers_;  ///< of each emitter and all before it
    std::vector<Light> lights_;   ///< in the order of their triangles
};

}  // namespace bwfirt
