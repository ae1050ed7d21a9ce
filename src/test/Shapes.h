// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/Triangle.h"

#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace bwfirt::test {

using Triangles = std::vector<Triangle>;

/// Two triangles with the corners a b c d, in this order around the quadrilateral.
Triangles quad(const V3f& a, const V3f& b, const V3f& c, const V3f& d);

/// The six sides of an axis-aligned box, each divided in `squares` times `squares` rectangles of
/// two triangles. The mesh is closed.
Triangles box(const V3f& low, const V3f& high, int squares = 1);

/// A closed mesh around the centre: an icosahedron whose triangles are divided in four `levels`
/// times, 20 * 4^levels triangles. Its vertices lie at the radius times 1 + bumps, where the bumps
/// depend on the direction alone, so that the mesh has no gaps.
Triangles sphere(const V3f& centre, double radius, int levels, double bumpHeight);

/// Triangles with random corners in a cube [-1, 1]^3, each about `size` long.
Triangles soup(std::size_t count, double size, std::mt19937& random);

/// All triangles of all parts, in order.
Triangles joined(std::initializer_list<Triangles> parts);

}  // namespace bwfirt::test
