// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/viewer/Keys.h"
#include "app/viewer/ViewerState.h"
#include "app/window/Window.h"

#include <map>
#include <optional>

namespace bwfirt {

/// Turns what SDL tells into commands.
class Input {
  public:
    explicit Input(const std::vector<KeyRow>& keys);

    /// The command of a key that goes down or up; nothing where it has none, or repeats one that
    /// is not gradual.
    std::optional<Command> commandOf(const SDL_KeyboardEvent& event) const;

    /// The mouse: a button held and moved looks around, a click picks, the wheel is the speed.
    void handleMouse(const SDL_Event& event, const Window& window, ViewerState& state);

    /// Forgets the mouse button that is held.
    void releaseMouse() { drag_.reset(); }

  private:
    struct Drag {
        Uint8 button;
        SDL_Point start;
        SDL_Point last;
        bool hasMoved = false;
    };

    void move(const SDL_MouseMotionEvent& event, const Window& window, ViewerState& state);

    std::map<std::pair<SDL_Keycode, bool>, Command> commands_;  ///< by key and Ctrl
    std::optional<Drag> drag_;
};

}  // namespace bwfirt
