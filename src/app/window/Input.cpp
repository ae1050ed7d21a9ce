// SPDX-License-Identifier: GPL-3.0-only
#include "app/window/Input.h"

namespace bwfirt {

namespace {

constexpr int LARGEST_CLICK = 3;  // a hand trembles so many pixels

/// Whether a key that is held does it again and again.
bool isGradual(Command command) {
    using enum Command;
    switch (command) {
        case SPEED_UP:
        case SLOW_DOWN:
        case MORE_EXPOSURE:
        case LESS_EXPOSURE:
        case MORE_EXITANCE:
        case LESS_EXITANCE:
            return true;
        default:
            return false;
    }
}

}  // namespace

Input::Input(const std::vector<KeyRow>& keys) {
    for (const KeyRow& row : keys)
        for (const KeyBinding& binding : row.bindings)
            commands_[{SDL_GetKeyFromName(binding.key.c_str()), binding.withControl}] =
                binding.command;
}

std::optional<Command> Input::commandOf(const SDL_KeyboardEvent& event) const {
    // A key that goes up ends what it began, whatever modifiers have come or gone meanwhile.
    const int modifiers = event.state == SDL_PRESSED ? int{event.keysym.mod} : 0;
    if ((modifiers & (KMOD_ALT | KMOD_GUI)) != 0)
        return std::nullopt;
    const auto found = commands_.find({event.keysym.sym, (modifiers & KMOD_CTRL) != 0});
    if (found == commands_.end() || (event.repeat != 0 && !isGradual(found->second)))
        return std::nullopt;
    return found->second;
}

void Input::handleMouse(const SDL_Event& event, const Window& window, ViewerState& state) {
    switch (event.type) {
        case SDL_MOUSEWHEEL:
            state.changeSpeed(event.wheel.y);
            break;
        case SDL_MOUSEBUTTONDOWN:
            if (!drag_) {
                const SDL_Point place{event.button.x, event.button.y};
                drag_ = {event.button.button, place, place};
            }
            break;
        case SDL_MOUSEMOTION:
            move(event.motion, window, state);
            break;
        case SDL_MOUSEBUTTONUP:
            if (!drag_ || drag_->button != event.button.button)
                break;
            if (!drag_->hasMoved) {
                const SDL_Point pixel = window.pixelAt(event.button.x, event.button.y);
                state.pickAt(pixel.x, pixel.y);
            }
            drag_.reset();
            break;
        default:
            break;
    }
}

void Input::move(const SDL_MouseMotionEvent& event, const Window& window, ViewerState& state) {
    if (!drag_)
        return;
    const int dx = event.x - drag_->start.x, dy = event.y - drag_->start.y;
    drag_->hasMoved |= dx * dx + dy * dy > LARGEST_CLICK * LARGEST_CLICK;
    if (!drag_->hasMoved)
        return;
    const SDL_Point from = window.pixelAt(drag_->last.x, drag_->last.y);
    const SDL_Point to = window.pixelAt(event.x, event.y);
    drag_->last = {event.x, event.y};
    if (drag_->button == SDL_BUTTON_LEFT)
        state.look(to.x - from.x, to.y - from.y);
}

}  // namespace bwfirt
