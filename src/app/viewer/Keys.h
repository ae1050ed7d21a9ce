// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace bwfirt {

/// What a key of the viewer does.
enum class Command {
    FORWARD,
    LEFT,
    BACK,
    RIGHT,
    DOWN,
    UP,
    FAST,
    SPEED_UP,
    SLOW_DOWN,
    LIGHT_MODE,
    UNDO,
    MORE_EXITANCE,
    LESS_EXITANCE,
    SAVE_SCENE,
    SAVE_CAMERA,
    SAVE_PICTURE,
    VIEW_LIGHT,
    VIEW_NORMALS,
    VIEW_TRIANGLES,
    VIEW_DISTANCE,
    VIEW_QUERIES,
    VIEW_ERRORS,
    MORE_EXPOSURE,
    LESS_EXPOSURE,
    RESET_EXPOSURE,
    BACK_TO_START,
    PAUSE,
    FULLSCREEN,
    HELP,
    STATUS,
    QUIT,
};

struct KeyBinding {
    std::string key;  ///< its name for SDL_GetKeyFromName
    Command command;
    bool withControl = false;
};

/// A line of the help: keys that belong together, or what the mouse does.
struct KeyRow {
    std::string keys;  ///< as people call them
    std::string meaning;
    std::vector<KeyBinding> bindings;  ///< none for the mouse
};

/// All keys of the viewer. The event loop, the help overlay and --help are made of this table.
/// @param dvorak the keys that move lie where w a s d q e are, on a Dvorak keyboard
std::vector<KeyRow> keyTable(bool dvorak);

/// The table as text, a row a line.
std::string keyHelp(const std::vector<KeyRow>& table);

}  // namespace bwfirt
