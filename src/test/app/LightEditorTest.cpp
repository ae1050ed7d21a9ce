// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/LightEditor.h"

#include "test/Shapes.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

using Lights = std::vector<Light>;

class LightEditing : public testing::Test {
  protected:
    LightEditor editorOf(const Lights& lights) const { return {triangles, lights}; }

    /// The lights after these triangles have been picked, one after the other.
    Lights lightsAfter(const Lights& lights, std::initializer_list<std::uint32_t> picks) const {
        LightEditor editor = editorOf(lights);
        for (const std::uint32_t triangle : picks)
            editor.toggle(triangle);
        return editor.lights();
    }

    test::Triangles triangles = test::sphere(V3f(0), 1, 1, 0);
};

TEST_F(LightEditing, APickMakesALightAndAnotherOneUnmakesIt) {
    EXPECT_EQ(lightsAfter({}, {7}), (Lights{{7, 7, 100}}));
    EXPECT_EQ(lightsAfter({}, {7, 7}), Lights{});
}

TEST_F(LightEditing, SuccessiveTrianglesMergeInWhateverOrderTheyArePicked) {
    EXPECT_EQ(lightsAfter({}, {7, 8, 9}), (Lights{{7, 9, 100}}));
    EXPECT_EQ(lightsAfter({}, {9, 7, 8}), (Lights{{7, 9, 100}}));
    EXPECT_EQ(lightsAfter({}, {9, 7}), (Lights{{7, 7, 100}, {9, 9, 100}}));
    EXPECT_EQ(lightsAfter({}, {0, 1}), (Lights{{0, 1, 100}}));
}

TEST_F(LightEditing, ATriangleBesideALightGetsItsExitance) {
    EXPECT_EQ(lightsAfter({{4, 5, 20}}, {6}), (Lights{{4, 6, 20}}));
    EXPECT_EQ(lightsAfter({{4, 5, 20}}, {3}), (Lights{{3, 5, 20}}));
}

TEST_F(LightEditing, BetweenTwoLightsOfDifferentExitanceItJoinsTheFirst) {
    EXPECT_EQ(lightsAfter({{4, 5, 20}, {7, 8, 30}}, {6}), (Lights{{4, 6, 20}, {7, 8, 30}}));
    EXPECT_EQ(lightsAfter({{7, 8, 20}, {4, 5, 20}}, {6}), (Lights{{4, 8, 20}}));
}

TEST_F(LightEditing, ATriangleTakenOutOfTheMiddleLeavesTwoLights) {
    EXPECT_EQ(lightsAfter({{4, 8, 20}}, {6}), (Lights{{4, 5, 20}, {7, 8, 20}}));
    EXPECT_EQ(lightsAfter({{4, 8, 20}}, {4}), (Lights{{5, 8, 20}}));
    EXPECT_EQ(lightsAfter({{4, 8, 20}}, {8}), (Lights{{4, 7, 20}}));
}

TEST_F(LightEditing, WhatIsLeftOfALightHasAnArea) {
    triangles[5] = {{V3f(0), V3f(0), V3f(0)}};
    EXPECT_EQ(lightsAfter({{4, 6, 20}}, {4, 6}), Lights{}) << "a file with it could not be read";
}

TEST_F(LightEditing, UntilAPickTheLightsAreThoseOfTheFileInItsOrder) {
    const Lights lights = {{9, 9, 1}, {2, 3, 4}};
    LightEditor editor = editorOf(lights);
    EXPECT_EQ(editor.lights(), lights);
    EXPECT_FALSE(editor.isChanged());
}

TEST_F(LightEditing, ExitanceStepsAlongPreferredNumbers) {
    LightEditor editor = editorOf({{2, 3, 22.34}});
    editor.changeExitance(1);
    EXPECT_EQ(editor.lights()[0].exitance, 25);
    editor.changeExitance(-1);
    EXPECT_EQ(editor.lights()[0].exitance, 20);
    editor.changeExitance(-13);
    EXPECT_EQ(editor.lights()[0].exitance, 1);
    editor.changeExitance(-1);
    EXPECT_EQ(editor.lights()[0].exitance, 0.8);
    editor.changeExitance(31);
    EXPECT_EQ(editor.lights()[0].exitance, 1000);
}

TEST_F(LightEditing, ExitanceStaysAboveZeroAndFinite) {
    LightEditor editor = editorOf({{2, 3, 0}});
    editor.changeExitance(-500);
    EXPECT_EQ(editor.lights()[0].exitance, 1e-6);
    editor.changeExitance(5000);
    EXPECT_EQ(editor.lights()[0].exitance, 1e12);
}

TEST_F(LightEditing, ExitanceChangesOnThePickedLightOrElseOnAll) {
    LightEditor editor = editorOf({{2, 3, 10}, {5, 6, 100}});
    editor.changeExitance(1);
    EXPECT_EQ(editor.lights(), (Lights{{2, 3, 12.5}, {5, 6, 125}}));
    editor.toggle(7);
    editor.changeExitance(1);
    EXPECT_EQ(editor.lights(), (Lights{{2, 3, 12.5}, {5, 7, 160}}));
    editor.toggle(0);
    EXPECT_EQ(editor.lights()[0], (Light{0, 0, 160})) << "a new light gets the last exitance";
}

TEST_F(LightEditing, UndoTakesBackEachChangeInTurn) {
    const Lights lights = {{9, 9, 1}, {2, 3, 4}};
    LightEditor editor = editorOf(lights);
    editor.toggle(5);
    const Lights afterFirst = editor.lights();
    editor.changeExitance(3);
    EXPECT_TRUE(editor.undo());
    EXPECT_EQ(editor.lights(), afterFirst);
    EXPECT_TRUE(editor.undo());
    EXPECT_EQ(editor.lights(), lights);
    EXPECT_FALSE(editor.undo());
    EXPECT_FALSE(editor.isChanged());
}

TEST_F(LightEditing, WhatIsSavedIsNotChanged) {
    LightEditor editor = editorOf({});
    editor.toggle(5);
    EXPECT_TRUE(editor.isChanged());
    editor.markSaved();
    EXPECT_FALSE(editor.isChanged());
    editor.undo();
    EXPECT_TRUE(editor.isChanged());
}

}  // namespace
}  // namespace bwfirt
