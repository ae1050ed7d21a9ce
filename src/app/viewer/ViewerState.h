// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "app/viewer/Display.h"
#include "app/viewer/Flight.h"
#include "app/viewer/Keys.h"
#include "app/viewer/LightEditor.h"
#include "app/viewer/Pick.h"

#include <functional>

namespace bwfirt {

/// What the user of the viewer does, and what follows from it. It needs no window: that hands it
/// commands and clicks, and draws what it holds.
class ViewerState {
  public:
    /// @param renderer must be ready; both must outlive the state
    ViewerState(const Settings& settings, LiveRenderer& renderer);

    // ---- What the user does. Positions are in pixels.

    void resize(int width, int height);

    /// A key goes down, or up again: what moves the camera lasts from one to the other.
    void press(Command command);
    void release(Command command);
    void releaseAll() { flight_.releaseAll(); }
    void look(int pixelsRight, int pixelsDown);
    void changeSpeed(int steps);
    void pickAt(int x, int y);

    /// Nobody sees the window, and nothing is refined meanwhile.
    void setHidden(bool isHidden);

    /// Goes on by the time since the last call. True where there is something new to draw.
    bool update();

    /// The picture has been drawn.
    void drawn();

    // ---- What there is to see.

    const std::shared_ptr<const Picture>& picture() const { return picture_; }
    const Flight& flight() const { return flight_; }
    const LightEditor& editor() const { return editor_; }
    const std::optional<Pick>& pick() const { return pick_; }
    Exposure exposure() const { return exposure_; }
    bool isInLightMode() const { return isInLightMode_; }
    bool isPaused() const { return isPaused_; }
    bool showsStatus() const { return showsStatus_; }
    bool showsLegend() const;

    /// What was told last; empty after a while.
    std::string message() const;

    /// From the last change to the drawing of its first picture.
    double secondsOfReaction() const { return secondsOfReaction_; }

  private:
    using Clock = std::chrono::steady_clock;

    /// Something that is shown for a while.
    struct Moment {
        Clock::time_point begin{};
        bool isOver() const;
    };

    void choose(std::optional<View> view);
    void expose(double stops);
    void editLights(const std::function<void()>& edit);
    void attempt(const std::function<void()>& work);
    void pause();
    void saveCamera();
    void savePicture();
    void saveScene();
    void say(const std::string& text);
    void updateWish();

    const Settings& settings_;
    LiveRenderer& renderer_;
    Flight flight_;
    LightEditor editor_;
    std::optional<View> view_;
    std::optional<Wish> wish_;
    std::shared_ptr<const Picture> picture_;
    std::optional<Pick> pick_;
    Exposure exposure_;
    int width_ = 1;
    int height_ = 1;
    bool isInLightMode_ = false;
    bool isPaused_ = false;
    bool isHidden_ = false;
    bool showsStatus_ = false;
    bool isChanged_ = true;  ///< since it was drawn last

    std::string message_;
    Moment messageShown_;
    Moment legendShown_;
    double secondsOfReaction_ = 0;
    Clock::time_point answered_{};  ///< the wish that secondsOfReaction_ is of
    Clock::time_point lastUpdate_ = Clock::now();
};

}  // namespace bwfirt
