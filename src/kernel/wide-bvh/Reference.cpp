// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/wide-bvh/Reference.h"

namespace bwfirt::wide {

namespace {

/// A number above, or below, by at least one step of single precision.
Float4 above(const Float4& v) {
    const Float4 size = v < 0 ? -v : v;
    return v + (size * std::numeric_limits<float>::epsilon() +
                std::numeric_limits<float>::denorm_min());
}
Float4 below(const Float4& v) {
    return -above(-v);
}

/// Where the edge from a to b, computed in double precision, meets the plane.
Box crossing(const V3f& a, const V3f& b, const Plane& plane) {
    const auto [axis, position] = plane;
    const double s =
        (static_cast<double>(position) - a[axis]) / (static_cast<double>(b[axis]) - a[axis]);
    const Float4 point = toFloat4(V3f((1 - s) * V3d(a) + s * V3d(b)));
    return {below(point), above(point)};
}

/// The part of a box on one side of a plane that is within it, up to rounding.
Box half(Box box, const Plane& plane, bool isBelow) {
    const auto [axis, position] = plane;
    const Float4 at{position, position, position, position};
    if (isBelow)
        box.high[axis] = std::max(std::min(box.high[axis], above(at)[0]), box.low[axis]);
    else
        box.low[axis] = std::min(std::max(box.low[axis], below(at)[0]), box.high[axis]);
    box.low[3] = box.low[0];
    box.high[3] = box.high[0];
    return box;
}

}  // namespace

Parts cut(const Reference& reference, const Triangle& triangle, const Plane& plane) {
    const auto [axis, position] = plane;
    Box partBelow = Box::empty(), partAbove = Box::empty();
    for (std::size_t i = 0; i < 3; ++i) {
        const V3f& a = triangle.vertices[i];
        const V3f& b = triangle.vertices[(i + 1) % 3];
        if (a[axis] <= position)
            partBelow.extend(toFloat4(a));
        if (a[axis] >= position)
            partAbove.extend(toFloat4(a));
        if ((a[axis] < position) != (b[axis] < position)) {
            const Box point = crossing(a, b, plane);
            partBelow.extend(point);
            partAbove.extend(point);
        }
    }
    // A part that rounding has left without any points is as large as it may be.
    const auto reduce = [&](const Box& part, bool isBelow) {
        const Box most = half(reference.box(), plane, isBelow);
        Box result = most;
        result.intersect(part);
        return Reference(result.isEmpty() ? most : result, reference.triangle());
    };
    return {reduce(partBelow, true), reduce(partAbove, false)};
}

}  // namespace bwfirt::wide
