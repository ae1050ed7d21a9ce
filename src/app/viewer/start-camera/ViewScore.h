// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace bwfirt {

/// What a ray of a coarse picture meets.
struct Sight {
    double distance;
    std::uint32_t triangle;
    bool isFront;   ///< its vertices run counter-clockwise
    bool isDetail;  ///< it lies where most triangles of the scene do
};

/// A picture row by row, with nothing where a ray leaves the scene.
struct CoarsePicture {
    int width;
    std::vector<std::optional<Sight>> sights;
};

/// How good a first picture of a scene is, 0 where it shows nothing: geometry fills it, at a
/// distance, with many different triangles, and what the scene is made of lies in its middle.
/// @param slope of the direction of view, upwards
/// @param detailSize length of the diagonal of the box in which most triangles lie
/// @param areVerticesClockwise of triangles that are seen from outside
double viewScore(const CoarsePicture& picture, double slope, double detailSize,
                 bool areVerticesClockwise);

}  // namespace bwfirt
