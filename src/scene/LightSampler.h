// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

#include <array>
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

    /// The triangles to which random numbers u[0], u[1], ... in [0, 1) belong. Must not be called
    /// where the total power is 0. What is found for one of them does not wait for another.
    /// @tparam Numbers as many as COUNT, of type double
    template <std::size_t COUNT, typename Numbers>
    std::array<const Emitter*, COUNT> choose(const Numbers& u) const {
        // The first emitter beyond the target. Which half it is in cannot be predicted, hence a
        // factor instead of a branch.
        std::array<std::size_t, COUNT> found{};
        for (std::size_t count = powers_.size(); count > 1; count -= count / 2)
            for (std::size_t i = 0; i < COUNT; ++i)
                found[i] +=
                    (powers_[found[i] + count / 2 - 1] <= u[i] * powers_.back()) * (count / 2);
        std::array<const Emitter*, COUNT> emitters;
        for (std::size_t i = 0; i < COUNT; ++i)
            emitters[i] = &emitters_[found[i]];
        return emitters;
    }

    /// The radiance that the triangle emits, 0 where it is no light.
    double radiance(std::uint32_t triangle) const;

  private:
    std::vector<Emitter> emitters_;
    std::vector<double> powers_;  ///< of each emitter and all before it
    std::vector<Light> lights_;   ///< in the order of their triangles
};

}  // namespace bwfirt
