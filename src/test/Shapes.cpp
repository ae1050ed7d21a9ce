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

Triangles box(const V3f& l, const V3f& h) {
    return joined({quad({l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z}),
                   quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z}),
                   quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z}),
                   quad({l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}),
                   quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z}),
                   quad({h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z})});
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
