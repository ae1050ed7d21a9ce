// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/RTKernel.h"
#include "kernel/wide-bvh/RayConstants.h"

#include <span>

namespace bwfirt::wide {

/// A ray's or a segment's points origin + t * direction.
inline const V3f& originOf(const Ray& ray) {
    return ray.origin;
}
inline const V3f& directionOf(const Ray& ray) {
    return ray.direction;
}
inline const V3f& originOf(const RTKernel::Segment& segment) {
    return segment.x;
}
inline V3f directionOf(const RTKernel::Segment& segment) {
    return segment.y - segment.x;
}

/// Up to SIZE rays, with a bit for each. Their constants stand number by number, so that they are
/// computed for several rays at once.
class RayBatch {
  public:
    static constexpr std::size_t SIZE = 16;
    using Bits = std::uint32_t;

    /// @param questions rays or segments
    /// @param reach the largest coordinate of the scene, up to its sign
    template <typename Question>
    RayBatch(std::span<const Question> questions, float reach) {
        for (std::size_t i = 0; i < SIZE; ++i) {
            const Question& question = questions[std::min(i, questions.size() - 1)];
            const V3f origin = originOf(question), direction = directionOf(question);
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                origin_[a][i] = origin[axis];
                direction_[a][i] = direction[axis];
            }
        }
        setConstants(reach);
        for (std::size_t i = 0; i < questions.size(); ++i)
            canBeAsked_ |= Bits{canBeAskedEach_[i]} << i;
    }

    /// Those whose numbers are finite, and that have a direction.
    Bits canBeAsked() const { return canBeAsked_; }

    /// Which coordinates' direction is negative: a bit for each axis.
    std::uint32_t octant(std::size_t ray) const { return octant_[ray]; }

    RayConstants operator[](std::size_t ray) const {
        RayConstants constants;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constants.inverse[axis] = inverse_[axis][ray];
            constants.nearOffset[axis] = nearOffset_[axis][ray];
            constants.farOffset[axis] = farOffset_[axis][ray];
            constants.nearPlane[axis] = nearPlane_[axis][ray];
            constants.farPlane[axis] = farPlane_[axis][ray];
        }
        constants.setTriangleAxes(longest_[ray], Column{origin_, ray}, Column{direction_, ray},
                                  Column{inverse_, ray});
        return constants;
    }

  private:
    template <typename Number>
    using Row = std::array<Number, SIZE>;
    template <typename Number>
    using Rows = std::array<Row<Number>, 3>;  ///< by axis

    struct Column {
        const Rows<float>& rows;
        std::size_t ray;
        template <typename Axis>
        float operator[](Axis axis) const {
            return rows[static_cast<std::size_t>(axis)][ray];
        }
    };

    /// Without a branch, so that compilers make vectors of it.
    void setConstants(float reach) {
        for (std::size_t i = 0; i < SIZE; ++i) {
            const float x = std::abs(direction_[0][i]), y = std::abs(direction_[1][i]),
                        z = std::abs(direction_[2][i]);
            const float longest = std::max(std::max(x, y), z);
            float allNumbers = 0;
            std::uint32_t octant = 0;
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const AxisConstants<float> one(axis, origin_[axis][i], direction_[axis][i], longest,
                                               reach);
                inverse_[axis][i] = one.inverse;
                nearOffset_[axis][i] = one.nearOffset;
                farOffset_[axis][i] = one.farOffset;
                nearPlane_[axis][i] = one.nearPlane;
                farPlane_[axis][i] = one.farPlane;
                octant |= one.isBackwards << axis;
                allNumbers += 0 * origin_[axis][i] + 0 * direction_[axis][i];
            }
            octant_[i] = octant;
            longest_[i] = longestAxis(x, y, z);
            canBeAskedEach_[i] = ((allNumbers == 0) & (longest > 0)) ? 1 : 0;
        }
    }

    Rows<float> origin_, direction_, inverse_, nearOffset_, farOffset_;
    Rows<std::uint32_t> nearPlane_, farPlane_;
    Row<std::uint32_t> octant_;
    Row<int> longest_;
    Row<std::uint32_t> canBeAskedEach_;
    Bits canBeAsked_ = 0;
};

}  // namespace bwfirt::wide
