// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Camera.h"

#include <array>

namespace bwfirt {

/// Flies a camera through a scene: keys that are held move it, the mouse turns it.
class Flight {
  public:
    enum Direction { FORWARD, BACK, LEFT, RIGHT, DOWN, UP };

    /// @param sceneDiagonal the speed is proportional to it
    Flight(const Camera& start, double sceneDiagonal);

    const Camera& camera() const { return camera_; }

    /// A key goes down or up. A key that does both before the next advance() still moves once.
    void press(Direction direction);
    void release(Direction direction);
    void releaseAll();

    void setFast(bool isFast) { isFast_ = isFast; }

    /// Multiplies the speed, by 2^(1/4) a step.
    void changeSpeed(int steps);

    /// Scene units per second.
    double speed() const;

    bool isMoving() const;

    /// Moves as far as the keys that are held take it in this time: forward is where the camera
    /// looks, up is away from the ground.
    void advance(double seconds);

    /// Turns by these angles in radians, to the right and down, never over the vertical. A
    /// level horizon stays level.
    void look(double right, double down);

    /// The camera and the speed of the start.
    void backToStart();

  private:
    void moved();

    Camera start_;
    Camera camera_;
    V3d up_;  ///< away from the ground, unit length
    double startSpeed_;
    int speedSteps_ = 0;
    bool isFast_ = false;
    std::array<bool, 6> isHeld_{};
    std::array<bool, 6> isPending_{};  ///< pressed since the last advance()
};

}  // namespace bwfirt
