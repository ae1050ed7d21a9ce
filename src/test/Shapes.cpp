// SPDX-License-Identifier: GPL-3.0-only
#include "test/Shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace bwfirt::test {

namespace {

using Corners = std::array<V3d, 3>;  // on the unit sphere

std::vector<Corners> icosahedron() {
    const double phi = std::numbers::phi;
    std::vector<V3d> vertices;
    for (const double one : {-1.0, 1.0})
        for (const double golden : {-phi, phi})
            for (const V3d& v : {V3d(0, one, golden), V3d(one, golden, 0), V3d(golden, 0, one)})
                vertices.push_back(v.normalized());
    const double edge = 2 / std::sqrt(1 + phi * phi);
    const auto isEdge = [&](const V3d& a, const V3d& b) {
        return std::abs((a - b).length() - edge) < 1e-9;
    };
    std::vector<Corners> faces;
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = i + 1; j < 12; ++j)
            for (std::size_t k = j + 1; k < 12; ++k)
                if (isEdge(vertices[i], vertices[j]) && isEdge(vertices[j], vertices[k]) &&
                    isEdge(vertices[k], vertices[i]))
                    faces.push_back({vertices[i], vertices[j], vertices[k]});
    return faces;
}

/// The same for a - b and b - a, so that neighbours agree on the vertex between them.
V3d between(const V3d& a, const V3d& b) {
    return ((a + b) / 2).normalized();
}

std::vector<Corners> divided(const std::vector<Corners>& faces) {
    std::vector<Corners> result;
    for (const auto& [a, b, c] : faces) {
        const V3d ab = between(a, b), bc = between(b, c), ca = between(c, a);
        for (const Corners& part : {Corners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
            result.push_back(part);
    }
    return result;
}

}  // namespace

Triangles quad(const V3f& a, const V3f& b, const V3f& c, const V3f& d) {
    return {{{a, b, c}}, {{a, c, d}}};
}

Triangles box(const V3f& low, const V3f& high, int squares) {
    Triangles triangles;
    for (const int axis : {2, 1, 0}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const bool isHigh : {false, true}) {
            // The same numbers for all squares that meet in a corner.
            const auto corner = [&](int i, int j) {
                const V3d size = V3d(high) - V3d(low);
                V3f point = isHigh ? high : low;
                point[u] = static_cast<float>(low[u] + size[u] * i / squares);
                point[v] = static_cast<float>(low[v] + size[v] * j / squares);
                return point;
            };
            for (int i = 0; i < squares; ++i) {
                for (int j = 0; j < squares; ++j) {
                    const V3f a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                              d = corner(i, j + 1);
                    const Triangles square = isHigh ? quad(a, b, c, d) : quad(a, d, c, b);
                    triangles.insert(triangles.end(), square.begin(), square.end());
                }
            }
        }
    }
    return triangles;
}

Triangles sphere(const V3f& centre, double radius, int levels, double bumpHeight) {
    std::vector<Corners> faces = icosahedron();
    for (int i = 0; i < levels; ++i)
        faces = divided(faces);
    const auto place = [&](const V3d& v) {
        const double bump = std::sin(7 * v.x + 1) * std::sin(5 * v.y + 2) * std::sin(6 * v.z + 3);
        return V3f(V3d(centre) + radius * (1 + bumpHeight * bump) * v);
    };
    Triangles triangles;
    for (const auto& [a, b, c] : faces)
        triangles.push_back({{place(a), place(b), place(c)}});
    return triangles;
}

Triangles soup(std::size_t count, double size, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto point = [&] {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        return V3d(x, y, z);
    };
    Triangles triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const V3d centre = point();
        Triangle triangle;
        for (V3f& vertex : triangle.vertices)
            vertex = V3f(centre + size * point());
        triangles.push_back(triangle);
    }
    return triangles;
}

Triangles joined(std::initializer_list<Triangles> parts) {
    Triangles all;
    for (const Triangles& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace bwfirt::test
