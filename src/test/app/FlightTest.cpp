// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Flight.h"

#include <gtest/gtest.h>

#include <numbers>

namespace bwfirt {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double DIAGONAL = 12;  // a speed of 1 per second

/// At the origin, looking along -z, y up.
Camera level() {
    return {};
}

void expectNear(const V3d& found, const V3d& expected) {
    EXPECT_NEAR((found - expected).length(), 0, 1e-12) << found << " instead of " << expected;
}

V3d positionAfter(Flight::Direction direction, double seconds) {
    Flight flight(level(), DIAGONAL);
    flight.press(direction);
    flight.advance(seconds);
    return flight.camera().position;
}

TEST(Flight, EachKeyMovesInItsDirectionForAsLongAsItIsHeld) {
    expectNear(positionAfter(Flight::FORWARD, 2), V3d(0, 0, -2));
    expectNear(positionAfter(Flight::BACK, 2), V3d(0, 0, 2));
    expectNear(positionAfter(Flight::LEFT, 2), V3d(-2, 0, 0));
    expectNear(positionAfter(Flight::RIGHT, 2), V3d(2, 0, 0));
    expectNear(positionAfter(Flight::UP, 2), V3d(0, 2, 0));
    expectNear(positionAfter(Flight::DOWN, 0.5), V3d(0, -0.5, 0));
}

TEST(Flight, AReleasedKeyMovesNoMore) {
    Flight flight(level(), DIAGONAL);
    flight.press(Flight::FORWARD);
    flight.advance(1);
    flight.release(Flight::FORWARD);
    EXPECT_FALSE(flight.isMoving());
    flight.advance(1);
    expectNear(flight.camera().position, V3d(0, 0, -1));
}

TEST(Flight, ATapBetweenTwoStepsMovesForOneOfThem) {
    Flight flight(level(), DIAGONAL);
    flight.press(Flight::FORWARD);
    flight.release(Flight::FORWARD);
    flight.advance(0.25);
    flight.advance(0.25);
    expectNear(flight.camera().position, V3d(0, 0, -0.25));
}

TEST(Flight, ReleasingAllKeysForgetsTapsAndShiftToo) {
    Flight flight(level(), DIAGONAL);
    flight.press(Flight::FORWARD);
    flight.setFast(true);
    flight.releaseAll();
    flight.advance(1);
    expectNear(flight.camera().position, V3d(0));
    EXPECT_EQ(flight.speed(), 1);
}

TEST(Flight, OppositeKeysCancelAndADiagonalIsNoFaster) {
    Flight flight(level(), DIAGONAL);
    flight.press(Flight::LEFT);
    flight.press(Flight::RIGHT);
    flight.advance(1);
    expectNear(flight.camera().position, V3d(0));
    flight.release(Flight::LEFT);
    flight.press(Flight::FORWARD);
    flight.advance(1);
    EXPECT_NEAR(flight.camera().position.length(), 1, 1e-12);
}

TEST(Flight, TheSpeedGrowsWithTheSceneAndByStepsAndFourfoldWithShift) {
    EXPECT_EQ(Flight(level(), 10 * DIAGONAL).speed(), 10);
    Flight flight(level(), DIAGONAL);
    flight.changeSpeed(4);
    EXPECT_DOUBLE_EQ(flight.speed(), 2);
    flight.changeSpeed(-8);
    EXPECT_DOUBLE_EQ(flight.speed(), 0.5);
    flight.setFast(true);
    EXPECT_DOUBLE_EQ(flight.speed(), 2);
    flight.changeSpeed(1000000);
    flight.changeSpeed(1000000);
    EXPECT_TRUE(std::isfinite(flight.speed()));
}

TEST(Flight, LookingRightAndDownTurnsThereAndKeepsTheHorizonLevel) {
    Flight flight(level(), DIAGONAL);
    flight.look(PI / 2, 0);
    expectNear(flight.camera().direction, V3d(1, 0, 0));
    flight.look(0, PI / 4);
    expectNear(flight.camera().direction, V3d(1, -1, 0).normalized());
    flight.look(-PI / 2, 0);
    expectNear(flight.camera().direction, V3d(0, -1, -1).normalized());
    EXPECT_EQ(flight.camera().up, V3d(0, 1, 0));
}

TEST(Flight, LookingNeverTurnsOverTheVertical) {
    Flight flight(level(), DIAGONAL);
    flight.look(0, -10);
    EXPECT_NEAR(std::asin(flight.camera().direction.y), 89 * PI / 180, 1e-9);
    flight.look(0, 20);
    EXPECT_NEAR(std::asin(flight.camera().direction.y), -89 * PI / 180, 1e-9);
}

TEST(Flight, ACameraThatLooksSteeperThanThatIsNotTurnedByLookingAside) {
    Camera steep = level();
    steep.direction = V3d(0, -1, -0.001);
    Flight flight(steep, DIAGONAL);
    flight.look(0.1, 0);
    EXPECT_NEAR(flight.camera().direction.normalized().y, steep.direction.normalized().y, 1e-12);
}

TEST(Flight, UpIsTheAxisThatALeaningUpVectorMeans) {
    Camera camera;  // the conference room of the paper, whose sky is z
    camera.direction = V3d(0.915894, 0.400479, -0.0274723);
    camera.up = V3d(0.0102422, 0.0451014, 0.99893);
    Flight flight(camera, DIAGONAL);
    flight.press(Flight::UP);
    flight.advance(1);
    EXPECT_EQ(flight.camera().position, V3d(0, 0, 1));
    const auto roll = [&] {
        const V3d right = flight.camera().direction.cross(flight.camera().up).normalized();
        return right.z;
    };
    const double before = roll();
    flight.look(1, 0);
    EXPECT_NEAR(roll(), before, 1e-9) << "a camera that is a little rolled stays so";
}

TEST(Flight, ARolledCameraStaysRolled) {
    Camera camera;
    camera.up = V3d(1, 2, 0);
    Flight flight(camera, DIAGONAL);
    flight.look(0.3, 0.2);
    EXPECT_NEAR((flight.camera().up.normalized() - camera.up.normalized()).length(), 0, 1e-12);
}

TEST(Flight, UntilItMovesTheCameraIsThatOfTheFileToTheBit) {
    Camera camera = level();
    camera.direction = V3d(0, -3, -5);
    camera.up = V3d(0.1, 1, 0);
    camera.referenceAverageIntensity = V3d(0.5);
    Flight flight(camera, DIAGONAL);
    flight.advance(1);
    EXPECT_EQ(flight.camera(), camera);
}

TEST(Flight, AMovedCameraHasNoReferenceUntilItIsBackAtTheStart) {
    Camera camera = level();
    camera.referenceAverageIntensity = V3d(0.5);
    Flight flight(camera, DIAGONAL);
    flight.changeSpeed(3);
    flight.press(Flight::UP);
    flight.advance(1);
    EXPECT_FALSE(flight.camera().referenceAverageIntensity);
    flight.backToStart();
    EXPECT_EQ(flight.camera(), camera);
    EXPECT_EQ(flight.speed(), 1);
}

TEST(Flight, NoPositionIsBeyondWhatACameraFileMayHold) {
    Flight flight(level(), 1e38);
    flight.changeSpeed(80);
    flight.press(Flight::FORWARD);
    for (int i = 0; i < 100; ++i)
        flight.advance(1);
    EXPECT_EQ(flight.camera().position.z, -std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace bwfirt
