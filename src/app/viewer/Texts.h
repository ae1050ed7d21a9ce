// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/viewer/Display.h"
#include "app/viewer/Flight.h"
#include "app/viewer/LightEditor.h"
#include "app/viewer/Pick.h"

#include <string>
#include <vector>

namespace bwfirt {

using Lines = std::vector<std::string>;

/// How far loading is, after so many seconds of it.
std::string progressText(LiveRenderer::Stage stage, double seconds);

/// What the picture is and how fast it comes.
/// @param secondsOfReaction from the last wish to its first picture
Lines statusLines(const Picture& picture, const Settings& settings, const Flight& flight,
                  Exposure exposure, double secondsOfReaction);

/// What false colours mean; none for light transport.
Lines legendLines(const Picture& picture, double sceneDiagonal, Exposure exposure);

/// Whether the colours of a view go from those of 0 to those of 1 in viridis.
bool isScale(const std::optional<View>& view);

Lines pickLines(const std::optional<Pick>& pick);

Lines lightLines(const LightEditor& editor);

}  // namespace bwfirt
