// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/ViewScore.h"

#include <algorithm>

namespace bwfirt {

namespace {

// Chosen by looking at pictures of rooms, courtyards, forests, statues and a single tree.

/// Surfaces at this distance, in sizes of the details, are worth half of those far away. So large
/// that a whole object is seen, and a room from its far end.
constexpr double FAR = 2.5;
/// Where fewer of the surfaces than this show their outside, one looks from within an object: the
/// picture is worth but a part.
constexpr double FEW_OUTSIDES = 0.1, WITHIN = 0.2;
/// Parts of the picture that show different triangles, and details, beyond which more is no better,
/// lest the nose in the leaves sees most.
constexpr double ENOUGH_TRIANGLES = 0.4, ENOUGH_DETAIL = 0.25;
/// What a picture of one triangle, or without details, is worth yet.
constexpr double ONE_TRIANGLE = 0.3, NO_DETAIL = 0.1;
/// Loss by details off the middle, and by looking up or down from a little below the horizon.
constexpr double OFF_CENTRE_LOSS = 8, TILT_LOSS = 2, BEST_SLOPE = -0.15;

}  // namespace

double viewScore(const CoarsePicture& picture, double slope, double detailSize,
                 bool areVerticesClockwise) {
    const int pixels = static_cast<int>(picture.sights.size());
    const int width = picture.width, height = pixels / width;
    double openness = 0, outsides = 0, details = 0, x = 0, y = 0;
    std::vector<std::uint32_t> triangles;
    for (int i = 0; i < pixels; ++i) {
        const std::optional<Sight>& sight = picture.sights[static_cast<std::size_t>(i)];
        if (!sight)
            continue;
        triangles.push_back(sight->triangle);
        openness += 1 / (1 + FAR * detailSize / sight->distance);
        outsides += sight->isFront != areVerticesClockwise;
        if (sight->isDetail) {
            ++details;
            const int column = i % width, row = i / width;
            x += (column + 0.5) / width - 0.5;
            y += (row + 0.5) / height - 0.5;
        }
    }
    const double filled = static_cast<double>(triangles.size()) / pixels;
    const double inTheOpen = outsides < FEW_OUTSIDES * filled * pixels ? WITHIN : 1;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const double variety = static_cast<double>(triangles.size()) / pixels;
    const double offCentre = details > 0 ? (x * x + y * y) / (details * details) : 0;
    const double tilt = slope - BEST_SLOPE;
    return inTheOpen * filled * openness / pixels *
           (ONE_TRIANGLE + std::min(variety, ENOUGH_TRIANGLES)) *
           (NO_DETAIL + std::min(details / pixels, ENOUGH_DETAIL)) /
           (1 + OFF_CENTRE_LOSS * offCentre) / (1 + TILT_LOSS * tilt * tilt);
}

}  // namespace bwfirt
