// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <SDL2/SDL.h>
#include <SDL2/SDL_ttf.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bwfirt {

/// A line of text on a panel.
struct TextLine {
    std::string text;
    SDL_Color colour{230, 230, 230, 255};
};

/// A picture with panels of text over it, in a window. Positions and sizes are in pixels of the
/// display, of which a unit of SDL's window coordinates may have several.
///
/// What is drawn is seen after present().
class Window {
  public:
    enum class Corner { UPPER_LEFT, LOWER_LEFT, CENTRE };

    /// @throws std::runtime_error where there is no display or no font
    Window(const std::string& title, int width, int height);

    int width() const;
    int height() const;

    /// The pixel at a position in SDL's window coordinates.
    SDL_Point pixelAt(int x, int y) const;

    /// Whether nobody can see it, as an icon for instance.
    bool isHidden() const;

    void toggleFullScreen();

    /// The picture that drawPicture() draws, 8-bit sRGB, three bytes a pixel, at any size.
    void setPicture(int width, int height, std::span<const std::uint8_t> pixels);

    void clear();
    void drawPicture();

    /// Closed, in the order of its corners.
    void drawPolygon(std::span<const SDL_FPoint> corners, SDL_Color colour);

    /// Lines of text on a dark panel, and below them a bar with the colours of colourAt(0) to
    /// colourAt(1), where there is one.
    void drawPanel(Corner corner, const std::vector<TextLine>& lines,
                   const std::function<SDL_Color(double)>& colourAt = nullptr);

    void present();

  private:
    template <auto DESTROY>
    struct Destroyer {
        void operator()(auto* object) const { DESTROY(object); }
    };
    struct Libraries {
        Libraries();
        ~Libraries();
    };

    void openFont();
    std::unique_ptr<SDL_Texture, Destroyer<SDL_DestroyTexture>> textureOf(const TextLine& line);

    Libraries libraries_;
    std::unique_ptr<SDL_Window, Destroyer<SDL_DestroyWindow>> window_;
    std::unique_ptr<SDL_Renderer, Destroyer<SDL_DestroyRenderer>> renderer_;
    std::unique_ptr<SDL_Texture, Destroyer<SDL_DestroyTexture>> picture_;
    std::unique_ptr<TTF_Font, Destroyer<TTF_CloseFont>> font_;
    int pictureWidth_ = 0;
    int pictureHeight_ = 0;
};

}  // namespace bwfirt
