// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "kernel/wide-bvh/RayConstants.h"
#include "kernel/wide-bvh/WideTree.h"

namespace bwfirt::wide {

/// What single precision can tell of a ray and the triangles of a leaf.
struct LeafMeeting {
    Mask possible;  ///< those that may be met with t in (0, tMax); no others are
    Mask certain;   ///< those of them that are
};

/// The test of WatertightRay, for all triangles of a leaf at once and in single precision, with a
/// bound on its errors.
///
/// With e the unit roundoff, S the largest x or y of a vertex as the ray sees it, and Z the largest
/// z: origin, shear and their differences leave an error of at most e (2 S + 4.5 Z) in x and y, and
/// the two products of an edge's sign with their difference at most e (11 S^2 + 18 S Z).
inline LeafMeeting meet(const Leaf& leaf, const RayConstants& ray, float tMax) {
    constexpr float E = ROUNDING;
    const Floats vertexZ = leaf.coordinates(ray.z) - all(ray.originZ);
    const Floats vertexX =
        subtractProduct(leaf.coordinates(ray.x) - all(ray.originX), all(ray.shearX), vertexZ);
    const Floats vertexY =
        subtractProduct(leaf.coordinates(ray.y) - all(ray.originY), all(ray.shearY), vertexZ);
    const Ints a = leaf.vertexOf(0), b = leaf.vertexOf(1), c = leaf.vertexOf(2);
    const Floats ax = permute(vertexX, a), ay = permute(vertexY, a), az = permute(vertexZ, a);
    const Floats bx = permute(vertexX, b), by = permute(vertexY, b), bz = permute(vertexZ, b);
    const Floats cx = permute(vertexX, c), cy = permute(vertexY, c), cz = permute(vertexZ, c);
    const Floats u = multiplySubtract(cx, by, cy * bx);
    const Floats v = multiplySubtract(ax, cy, ay * cx);
    const Floats w = multiplySubtract(bx, ay, by * ax);

    const auto largest = [](Floats one, Floats two, Floats three) {
        return greatestAbsolute(greatestAbsolute(one, two), three);
    };
    const Floats size = greatestAbsolute(largest(ax, bx, cx), largest(ay, by, cy));
    const Floats depth = largest(az, bz, cz);
    const Floats edgeError = all(20 * E) * size * (size + depth);
    const Floats least = lesser(lesser(u, v), w), most = greater(greater(u, v), w);
    Mask possible = (isNotLess(least, -edgeError) | isNotLess(edgeError, most)) & leaf.triangles();
    if (possible == 0)
        return {0, 0};

    // The distance is met where u a.t + v b.t + w c.t lies between 0 and tMax times their sum.
    const Floats determinant = u + v + w;
    const auto weighted = [&](Floats ofA, Floats ofB, Floats ofC) {
        return timesSign(multiplyAdd(u, ofA, multiplyAdd(v, ofB, w * ofC)), determinant);
    };
    const Floats inverseZ = all(ray.inverseZ);
    const Floats ta = az * inverseZ, tb = bz * inverseZ, tc = cz * inverseZ;
    const Floats beyondA = ta - all(tMax), beyondB = tb - all(tMax), beyondC = tc - all(tMax);
    const Floats t = weighted(ta, tb, tc), beyond = weighted(beyondA, beyondB, beyondC);
    const Floats farthest = absolute(depth * inverseZ);
    const Floats roundings = all(6 * E) * absolute(determinant) * farthest;
    const Floats tError = multiplyAdd(all(4) * edgeError, farthest, roundings);
    const Floats beyondError =
        multiplyAdd(all(4) * edgeError, largest(beyondA, beyondB, beyondC), roundings);
    possible &= isNotLess(t, -tError) & isNotLess(beyondError, beyond);
    const Mask certain = (isLess(edgeError, least) | isLess(most, -edgeError)) & isLess(tError, t) &
                         isLess(beyond, -beyondError);
    return {possible, possible & certain};
}

}  // namespace bwfirt::wide
