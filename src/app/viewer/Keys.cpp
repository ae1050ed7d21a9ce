// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Keys.h"

#include <algorithm>

namespace bwfirt {

namespace {

KeyRow moving(bool dvorak) {
    using enum Command;
    if (dvorak)
        return {", a o e",
                "move forward, left, back, right",
                {{",", FORWARD}, {"a", LEFT}, {"o", BACK}, {"e", RIGHT}}};
    return {"w a s d",
            "move forward, left, back, right",
            {{"w", FORWARD}, {"a", LEFT}, {"s", BACK}, {"d", RIGHT}}};
}

KeyRow climbing(bool dvorak) {
    using enum Command;
    if (dvorak)
        return {"' .", "move down, up", {{"'", DOWN}, {".", UP}}};
    return {"q e", "move down, up", {{"q", DOWN}, {"e", UP}}};
}

}  // namespace

std::vector<KeyRow> keyTable(bool dvorak) {
    using enum Command;
    return {
        {"left button held", "look around", {}},
        moving(dvorak),
        climbing(dvorak),
        {"Shift", "move four times as fast", {{"Left Shift", FAST}, {"Right Shift", FAST}}},
        {"wheel, + -",
         "speed",
         {{"+", SPEED_UP},
          {"=", SPEED_UP},
          {"Keypad +", SPEED_UP},
          {"-", SLOW_DOWN},
          {"Keypad -", SLOW_DOWN}}},
        {"click, any button", "pick the triangle under the pointer", {}},
        {"l", "light mode: a click adds or removes a triangle", {{"l", LIGHT_MODE}}},
        {"u", "undo the last change of the lights", {{"u", UNDO}}},
        {"Up Down",
         "radiant exitance of the picked light, or of all",
         {{"Up", MORE_EXITANCE}, {"Down", LESS_EXITANCE}}},
        {"Ctrl+S", "write the scene file with these lights", {{"s", SAVE_SCENE, true}}},
        {"c", "write the camera to a file", {{"c", SAVE_CAMERA}}},
        {"p", "write the picture as PNG", {{"p", SAVE_PICTURE}}},
        {"1 2 3",
         "false colours: normals, triangles, distance",
         {{"1", VIEW_NORMALS}, {"2", VIEW_TRIANGLES}, {"3", VIEW_DISTANCE}}},
        {"4", "queries of a path; again: time of h", {{"4", VIEW_QUERIES}}},
        {"5", "errors: where simple-bvh answers differently", {{"5", VIEW_ERRORS}}},
        {"0", "light transport again", {{"0", VIEW_LIGHT}}},
        {"PageUp PageDown, Home",
         "exposure; as it was",
         {{"PageUp", MORE_EXPOSURE}, {"PageDown", LESS_EXPOSURE}, {"Home", RESET_EXPOSURE}}},
        {"r", "back to the start", {{"r", BACK_TO_START}}},
        {"Space", "pause", {{"Space", PAUSE}}},
        {"f", "full screen", {{"f", FULLSCREEN}}},
        {"Tab", "passes, Mrays/s, position, speed", {{"Tab", STATUS}}},
        {"h F1", "this help", {{"h", HELP}, {"F1", HELP}}},
        {"Esc", "quit", {{"Escape", QUIT}}},
    };
}

std::string keyHelp(const std::vector<KeyRow>& table) {
    std::size_t width = 0;
    for (const KeyRow& row : table)
        width = std::max(width, row.keys.size());
    std::string text;
    for (const KeyRow& row : table)
        text +=
            "  " + row.keys + std::string(width - row.keys.size() + 2, ' ') + row.meaning + "\n";
    return text;
}

}  // namespace bwfirt
