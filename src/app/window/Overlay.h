// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/viewer/ViewerState.h"
#include "app/window/Window.h"

namespace bwfirt {

/// Draws the outline of the picked triangle and the panels of text over the picture.
void drawOverlay(Window& window, const ViewerState& state, const Settings& settings,
                 const LiveRenderer& renderer);

void drawHelp(Window& window, const std::vector<KeyRow>& keys);

/// How far loading is.
void drawProgress(Window& window, const std::string& text);

}  // namespace bwfirt
