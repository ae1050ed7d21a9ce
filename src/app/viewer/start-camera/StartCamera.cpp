// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/start-camera/StartCamera.h"

#include "app/viewer/start-camera/SceneBoxes.h"
#include "app/viewer/start-camera/UpAxis.h"
#include "app/viewer/start-camera/ViewScore.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace bwfirt {

namespace {

// As in sampling, only + - * / and square roots decide: they are the same on every machine.

constexpr double FILM_SIZE_Y = 0.8;  // at depth 1: 44 degrees from bottom to top

// Two stages: a coarse panorama from many places, of which any 3 x 3 neighbouring rays make a
// picture, then closer looks from the best of them.
constexpr int PLACES = 36;
constexpr int COLUMNS = 12;
constexpr double COLUMN_TANGENT = 0.5773502691896258;  // of 30 degrees, a full turn in 12 columns
constexpr std::array SLOPES = {0.3, -0.1, -0.5, -0.9};
constexpr int FINALISTS = 4;
constexpr int GRID_WIDTH = 9, GRID_HEIGHT = 7;  // rays of a closer look
constexpr double LOWEST_SLOPE = -0.7, HIGHEST_SLOPE = 0.2;

/// An upright view: along a horizontal unit vector, and `slope` upwards.
struct View {
    V3d position{0};
    V3d heading{0};
    double slope = 0;
    double score = -1;
};

/// What is around a place: rows from above to below, columns from left to right.
struct Panorama {
    V3d position{0};
    std::array<V3d, COLUMNS> headings;
    std::array<std::array<std::optional<Sight>, COLUMNS>, SLOPES.size()> rows;
};

/// Whether most of what is seen shows its back.
bool showsBacks(const Panorama& panorama) {
    int balance = 0;
    for (const auto& row : panorama.rows)
        for (const std::optional<Sight>& sight : row)
            if (sight)
                balance += sight->isFront ? -1 : 1;
    return balance > 0;
}

/// The first of two views that are about as good, so that rounding does not decide.
void keepBetter(View& best, const View& view) {
    constexpr double CLEARLY = 1.001;
    if (view.score > CLEARLY * best.score)
        best = view;
}

/// Looks around in a scene.
class Scout {
  public:
    Scout(const Scene& scene, const RTKernel& kernel, const Imath::Box3d& bounds)
        : scene_(scene),
          kernel_(kernel),
          space_(spaceOf(bounds)),
          details_(detailsOf(scene, bounds)),
          surroundings_(surroundingsOf(details_, space_)) {
        const int axis = upAxis(scene);
        up_[axis] = 1;
        ahead_[(axis + 1) % 3] = 1;
    }

    Camera bestCamera();

  private:
    V3d place(int number) const;
    V3d turned(const V3d& heading, double tangent) const;
    Panorama panoramaFrom(const V3d& position) const;
    View bestOf(const Panorama& panorama) const;
    View towardsDetails(const V3d& position) const;
    View refined(const View& start) const;
    std::optional<Sight> look(const Ray& ray) const;
    View judged(View view, const CoarsePicture& picture) const;
    View lookedAt(const View& view) const;
    Camera cameraOf(const View& view) const;

    const Scene& scene_;
    const RTKernel& kernel_;
    Imath::Box3d space_;
    Imath::Box3d details_;
    Imath::Box3d surroundings_;
    V3d up_{0};
    V3d ahead_{0};
    bool areVerticesClockwise_ = false;  ///< of triangles that are seen from outside
};

/// Files do not agree on the side of a triangle from which its vertices run counter-clockwise. But
/// there is more room outside of objects than within, so that it is the side that most places see.
Camera Scout::bestCamera() {
    std::vector<Panorama> panoramas;
    panoramas.reserve(PLACES);
    for (int i = 0; i < PLACES; ++i)
        panoramas.push_back(panoramaFrom(place(i)));
    areVerticesClockwise_ = 2 * std::ranges::count_if(panoramas, showsBacks) > PLACES;

    std::vector<View> views;
    views.reserve(PLACES);
    for (const Panorama& panorama : panoramas)
        views.push_back(bestOf(panorama));
    std::ranges::stable_sort(views, std::ranges::greater(), &View::score);
    views.resize(FINALISTS);
    View best;
    for (const View& view : views) {
        keepBetter(best, towardsDetails(view.position));
        keepBetter(best, lookedAt(view));
    }
    return cameraOf(refined(best));
}

/// Half of the places are anywhere, half around the details, horizontally more at the border than
/// in the middle: there one has the scene in front.
V3d Scout::place(int number) const {
    // Roberts: "The unreasonable effectiveness of quasirandom sequences", 2018, in 3 dimensions.
    constexpr std::array STEPS = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    constexpr double BORDER = 0.03;  // not in the walls
    const Imath::Box3d& box = number < PLACES / 2 ? space_ : surroundings_;
    V3d position{0};
    for (int axis = 0; axis < 3; ++axis) {
        const double x = (number + 0.5) * STEPS[static_cast<std::size_t>(axis)];
        double part = x - std::floor(x);
        if (up_[axis] == 0)
            part *= part * (3 - 2 * part);
        part = BORDER + (1 - 2 * BORDER) * part;
        position[axis] = (1 - part) * box.min[axis] + part * box.max[axis];
    }
    return position;
}

V3d Scout::turned(const V3d& heading, double tangent) const {
    const V3d turned = heading + tangent * up_.cross(heading);
    return turned * (1 / std::sqrt(turned.dot(turned)));
}

Panorama Scout::panoramaFrom(const V3d& position) const {
    Panorama panorama{position, {}, {}};
    V3d heading = ahead_;
    for (std::size_t column = 0; column < COLUMNS; ++column) {
        panorama.headings[column] = heading;
        for (std::size_t row = 0; row < SLOPES.size(); ++row) {
            const V3d direction = heading + SLOPES[row] * up_;
            panorama.rows[row][column] = look({V3f(position), V3f(direction.normalized())});
        }
        heading = turned(heading, -COLUMN_TANGENT);  // to the right
    }
    return panorama;
}

View Scout::bestOf(const Panorama& panorama) const {
    View best;
    for (std::size_t column = 0; column < COLUMNS; ++column) {
        for (std::size_t row = 1; row + 1 < SLOPES.size(); ++row) {
            CoarsePicture picture{3, {}};
            for (const std::size_t r : {row - 1, row, row + 1})
                for (const std::size_t c : {column + COLUMNS - 1, column, column + 1})
                    picture.sights.push_back(panorama.rows[r][c % COLUMNS]);
            keepBetter(
                best, judged({panorama.position, panorama.headings[column], SLOPES[row]}, picture));
        }
    }
    return best;
}

View Scout::towardsDetails(const V3d& position) const {
    const V3d way = details_.center() - position;
    const V3d level = way - way.dot(up_) * up_;
    const double length = std::sqrt(level.dot(level));
    if (!(length > 0))
        return lookedAt({position, ahead_, 0});
    const double slope = std::clamp(way.dot(up_) / length, LOWEST_SLOPE, HIGHEST_SLOPE);
    return lookedAt({position, level / length, slope});
}

/// Turns, nods and steps as long as that is better.
View Scout::refined(const View& start) const {
    struct Change {
        double turn, nod, step;
    };
    View best = start;
    for (const double size : {0.25, 0.12}) {
        const View middle = best;
        for (const auto& [turn, nod, step] :
             {Change{1, 0, 0}, Change{-1, 0, 0}, Change{0, 1, 0}, Change{0, -1, 0}, Change{0, 0, 1},
              Change{0, 0, -1}}) {
            View view;
            view.heading = turned(middle.heading, size * turn);
            view.slope = std::clamp(middle.slope + size * nod, LOWEST_SLOPE, HIGHEST_SLOPE);
            view.position =
                middle.position + size * step * details_.size().length() * middle.heading;
            if (space_.intersects(view.position))
                keepBetter(best, lookedAt(view));
        }
    }
    return best;
}

std::optional<Sight> Scout::look(const Ray& ray) const {
    const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
    if (!hit)
        return std::nullopt;
    const V3d direction(ray.direction);
    const double distance = hit->distance;
    const bool isFront = edgeCross(scene_.triangles[hit->triangle]).dot(direction) < 0;
    const bool isDetail = details_.intersects(V3d(ray.origin) + distance * direction);
    return Sight{distance, hit->triangle, isFront, isDetail};
}

View Scout::judged(View view, const CoarsePicture& picture) const {
    view.score = viewScore(picture, view.slope, details_.size().length(), areVerticesClockwise_);
    return view;
}

View Scout::lookedAt(const View& view) const {
    const CameraRays rays(cameraOf(view), GRID_WIDTH, GRID_HEIGHT);
    CoarsePicture picture{GRID_WIDTH, {}};
    for (int y = 0; y < GRID_HEIGHT; ++y)
        for (int x = 0; x < GRID_WIDTH; ++x)
            picture.sights.push_back(look(rays.through(x + 0.5, y + 0.5)));
    return judged(view, picture);
}

Camera Scout::cameraOf(const View& view) const {
    Camera camera;
    camera.position = view.position;
    camera.direction = view.heading + view.slope * up_;
    camera.up = up_;
    camera.filmSizeY = FILM_SIZE_Y;
    return camera;
}

}  // namespace

Camera startCamera(const Scene& scene, const RTKernel& kernel) {
    return Scout(scene, kernel, boundsOf(scene)).bestCamera();
}

}  // namespace bwfirt
