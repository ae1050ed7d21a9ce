// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Scene.h"

#include <optional>
#include <span>

namespace bwfirt {

/// Makes lights of triangles, one by one. Triangles with successive indices become one light.
class LightEditor {
  public:
    /// @param triangles of the scene; they must outlive the editor
    LightEditor(std::span<const Triangle> triangles, std::vector<Light> lights);

    /// Ranges that do not overlap, each with at least one triangle that has an area.
    const std::vector<Light>& lights() const { return state_.lights; }

    /// Makes a triangle, which must have an area, part of a light, or none where it is one. Beside
    /// a light it joins it; elsewhere it becomes a light of its own, with exitance().
    void toggle(std::uint32_t triangle);

    /// Steps along the preferred numbers (ISO 3, R10: ten to the decade), up or down, with the
    /// exitance of the light that was picked last, or of all lights where none was.
    void changeExitance(int steps);

    /// The radiant exitance that a new light gets.
    double exitance() const { return state_.exitance; }

    /// Takes back the last change. False where there is none.
    bool undo();

    /// Whether lights() is other than what was saved, or given, last.
    bool isChanged() const { return state_.lights != saved_; }
    void markSaved() { saved_ = state_.lights; }

  private:
    struct State {
        std::vector<Light> lights;
        double exitance;
        std::optional<std::uint32_t> picked;
    };

    void remember();
    void add(std::uint32_t triangle);
    void remove(std::vector<Light>::iterator light, std::uint32_t triangle);
    std::vector<Light>::iterator lightOf(std::uint32_t triangle);

    std::span<const Triangle> triangles_;
    State state_;
    std::vector<State> history_;
    std::vector<Light> saved_;
};

}  // namespace bwfirt
