// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Ray.h"

#include <filesystem>
#include <optional>
#include <string>

namespace bwfirt {

/// A pinhole camera as its file describes it.
struct Camera {
    V3d position{0, 0, 0};
    V3d direction{0, 0, -1};    ///< any length but 0
    V3d up{0, 1, 0};            ///< any length, not parallel to direction
    double depth = 1;           ///< distance of the film from the pinhole
    double filmSizeY = 1;       ///< film height, in the unit of depth
    double sensorResponse = 1;  ///< factor on the radiance
    std::optional<V3d> referenceAverageIntensity;

    bool operator==(const Camera&) const = default;
};

/// Reads a camera file.
/// @throws std::runtime_error "<file>:<line>: <key>: <what was expected>"
Camera readCamera(const std::filesystem::path& path);

/// A camera file. Read again it gives the same camera to the bit. The lines of the comment come
/// first.
std::string cameraText(const Camera& camera, const std::string& comment = "");

void writeCamera(const std::filesystem::path& path, const Camera& camera);

/// The reference as a line of a camera file, with a comment behind it.
std::string referenceLine(const V3d& averageIntensity, const std::string& comment);

/// Replaces the reference's line in a camera file, or appends it; the rest stays as it is.
void writeReference(const std::filesystem::path& path, const std::string& line);

/// The rays of a camera for an image of a given size: what stays the same from pixel to pixel.
class CameraRays {
  public:
    CameraRays(const Camera& camera, int width, int height);

    /// The ray through the image point (x, y) in pixels: (0, 0) is the upper left corner of the
    /// image, (width, height) the lower right one.
    Ray through(double x, double y) const { return {origin_, V3f(direction(x, y))}; }

    /// Its origin, which all rays share, and its direction. Number is double, or several of them.
    const V3f& origin() const { return origin_; }
    template <typename Number>
    Vec3<Number> direction(const Number& x, const Number& y) const {
        using std::sqrt;
        const auto all = [](const V3d& v) {
            return Vec3<Number>(Number(v.x), Number(v.y), Number(v.z));
        };
        const Vec3<Number> d = all(toUpperLeft_) + x * all(alongRow_) + y * all(alongColumn_);
        return d * (1 / sqrt(d.dot(d)));
    }

    /// Where through() would have to go to meet a point, in homogeneous coordinates: the image
    /// point is (x / z, y / z) for z > 0, and the point is behind the camera for z < 0.
    V3d project(const V3d& point) const;

  private:
    V3f origin_;
    V3d toUpperLeft_;
    V3d alongRow_;
    V3d alongColumn_;
};

}  // namespace bwfirt
