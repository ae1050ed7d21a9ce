// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Flight.h"

#include <Imath/ImathQuat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bwfirt {

namespace {

constexpr double SECONDS_ACROSS_SCENE = 12;
constexpr double FAST_FACTOR = 4;
constexpr int MOST_SPEED_STEPS = 80;  // a factor of a million
constexpr double STEEPEST = 89 * std::numbers::pi / 180;

V3d rightOf(const Camera& camera) {
    return camera.direction.normalized().cross(camera.up.normalized()).normalized();
}

/// The sine of the angle by which the horizon is tilted where the sky is in this direction.
double rollOf(const Camera& camera, const V3d& sky) {
    return std::abs(rightOf(camera).dot(sky));
}

/// The camera's up may lean towards its direction, or away. The axis that it is nearest to is the
/// better guess of where the sky is, as long as the horizon is not far from level.
V3d awayFromGround(const Camera& camera) {
    constexpr double LARGEST_ROLL = 0.1;
    constexpr double SMALLEST_ANGLE = 0.01;  // between the sky and where the camera looks
    const V3d up = camera.up.normalized();
    V3d nearest(0);
    for (int axis = 0; axis < 3; ++axis) {
        V3d candidate(0);
        candidate[axis] = std::copysign(1.0, up[axis]);
        if (candidate.dot(up) > nearest.dot(up))
            nearest = candidate;
    }
    const bool isSky = rollOf(camera, nearest) < LARGEST_ROLL &&
                       camera.direction.normalized().cross(nearest).length() > SMALLEST_ANGLE;
    return isSky ? nearest : up;
}

}  // namespace

Flight::Flight(const Camera& start, double sceneDiagonal)
    : start_(start),
      camera_(start),
      up_(awayFromGround(start)),
      startSpeed_(sceneDiagonal / SECONDS_ACROSS_SCENE) {}

void Flight::press(Direction direction) {
    isHeld_[direction] = isPending_[direction] = true;
}

void Flight::release(Direction direction) {
    isHeld_[direction] = false;
}

void Flight::releaseAll() {
    isHeld_ = {};
    isPending_ = {};
    isFast_ = false;
}

void Flight::changeSpeed(int steps) {
    speedSteps_ = std::clamp(speedSteps_ + steps, -MOST_SPEED_STEPS, MOST_SPEED_STEPS);
}

double Flight::speed() const {
    return startSpeed_ * std::exp2(speedSteps_ / 4.0) * (isFast_ ? FAST_FACTOR : 1);
}

bool Flight::isMoving() const {
    const auto isSet = [](bool flag) { return flag; };
    return std::any_of(isHeld_.begin(), isHeld_.end(), isSet) ||
           std::any_of(isPending_.begin(), isPending_.end(), isSet);
}

void Flight::advance(double seconds) {
    if (!isMoving())
        return;
    const auto sign = [&](Direction plus, Direction minus) {
        const auto goes = [&](Direction direction) {
            return isHeld_[direction] || isPending_[direction] ? 1 : 0;
        };
        return static_cast<double>(goes(plus) - goes(minus));
    };
    const V3d along = sign(FORWARD, BACK) * camera_.direction.normalized() +
                      sign(RIGHT, LEFT) * rightOf(camera_) + sign(UP, DOWN) * up_;
    isPending_ = {};
    if (along == V3d(0))
        return;
    constexpr double FARTHEST = std::numeric_limits<float>::max();
    camera_.position += speed() * seconds * along.normalized();
    for (int axis = 0; axis < 3; ++axis)
        camera_.position[axis] = std::clamp(camera_.position[axis], -FARTHEST, FARTHEST);
    moved();
}

void Flight::look(double right, double down) {
    const V3d direction = camera_.direction.normalized();
    const double elevation = std::asin(std::clamp(direction.dot(up_), -1.0, 1.0));
    const double turned =
        std::clamp(elevation - down, std::min(elevation, -STEEPEST), std::max(elevation, STEEPEST));
    const auto rotate = [](const V3d& vector, const V3d& axis, double angle) {
        return Imath::Quatd().setAxisAngle(axis, angle).rotateVector(vector);
    };
    const V3d axis = rightOf(camera_);
    const auto turn = [&](const V3d& vector) {
        return rotate(rotate(vector, axis, turned - elevation), up_, -right);
    };
    constexpr double LEVEL = 1e-6;
    camera_.up = rollOf(camera_, up_) < LEVEL ? up_ : turn(camera_.up);
    camera_.direction = turn(camera_.direction);
    moved();
}

void Flight::backToStart() {
    camera_ = start_;
    speedSteps_ = 0;
}

void Flight::moved() {
    camera_.referenceAverageIntensity.reset();
}

}  // namespace bwfirt
