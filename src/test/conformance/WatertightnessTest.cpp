// SPDX-License-Identifier: GPL-3.0-only
#include "kernel/KernelInfo.h"
#include "test/conformance/Conformance.h"

// Rays from inside closed meshes, aimed at the interiors, the edges and the vertices of triangles.
// None may leave but as many in a million as the kernel's README allows for.

namespace bwfirt::test {
namespace {

// Sanitizers look for errors of memory and races, and slow every ray down.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool IS_SANITIZED = true;
#elif defined(__has_feature)
constexpr bool IS_SANITIZED = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool IS_SANITIZED = false;
#endif

constexpr std::size_t RAYS = IS_SANITIZED ? 6000 : 60000;  // of each class, at each mesh

const V3f CENTRE(11, -7, 3);

V3d pointOnEdge(const Triangle& triangle, std::mt19937& random) {
    const std::size_t first = random() % 3;
    const V3d a(triangle.vertices[first]), b(triangle.vertices[(first + 1) % 3]);
    return a + std::uniform_real_distribution<double>(0, 1)(random) * (b - a);
}

V3d vertex(const Triangle& triangle, std::mt19937& random) {
    return V3d(triangle.vertices[random() % 3]);
}

/// A ray is missed where h finds nothing, and also where V connects its origin to a point as far
/// behind the mesh.
template <typename Target>
double missesPerMillion(const RTKernel& kernel, const Triangles& mesh, const Target& target) {
    RandomPoints origins(CENTRE, 0.3);
    std::mt19937 random(11);
    std::vector<RTKernel::Segment> rays;
    for (std::size_t i = 0; i < RAYS; ++i)
        rays.push_back({origins.next(), V3f(target(mesh[i % mesh.size()], random))});
    int misses = 0;
#pragma omp parallel for reduction(+ : misses)
    for (std::size_t i = 0; i < RAYS; ++i) {
        const auto& [inside, aim] = rays[i];
        const V3f outside = 2.0F * aim - inside;
        const bool isStopped = kernel.kernelIntersectGeometry(towards(inside, aim)) &&
                               !kernel.kernelVisibility(inside, outside);
        misses += isStopped ? 0 : 1;
    }
    return 1e6 * misses / RAYS;
}

void expectNoMoreMissesThanPromised(const char* name, const Triangles& mesh) {
    const auto kernel = kernelFor(mesh);
    const double interiors = missesPerMillion(*kernel, mesh, pointInside);
    const double edges = missesPerMillion(*kernel, mesh, pointOnEdge);
    const double vertices = missesPerMillion(*kernel, mesh, vertex);
    std::printf(
        "%s, %s, %zu rays each: misses per million at interiors, edges, vertices: "
        "%.4g, %.4g, %.4g\n",
        KernelInfo::NAME, name, RAYS, interiors, edges, vertices);
    EXPECT_LE(interiors, KernelInfo::MISSES_AT_INTERIORS);
    EXPECT_LE(edges, KernelInfo::MISSES_AT_EDGES);
    EXPECT_LE(vertices, KernelInfo::MISSES_AT_VERTICES);
}

TEST(Watertightness, DisplacedSphereOffTheOrigin) {
    expectNoMoreMissesThanPromised("displaced sphere", sphere(CENTRE, 2, 2, 0.1));
}

TEST(Watertightness, BoxOffTheOrigin) {
    // Whatever halves space meets the edges of these squares.
    expectNoMoreMissesThanPromised("box", box(CENTRE - V3f(2), CENTRE + V3f(1.1F, 1.2F, 1.3F), 8));
}

TEST(Watertightness, SegmentsExactlyThroughEdgesAndVertices) {
    const Triangles triangles = grid();
    const auto kernel = kernelFor(triangles);
    int segments = 0, misses = 0;
    for (int x = 1; x < 16; ++x) {
        for (int y = 1; y < 16; ++y) {
            const V3f point(x / 2.0F, y / 2.0F, 0);
            for (const V3f& step : {V3f(0, 0, 1), V3f(1, 2, 3), V3f(-3, 1, 2), V3f(5, -2, 1),
                                    V3f(-4, -7, -3), V3f(0, 3, -0.5F), V3f(6, -6, 0.125F)}) {
                ++segments;
                misses += kernel->kernelVisibility(point - step, point + step) ? 1 : 0;
            }
        }
    }
    const double promised = KernelInfo::MISSES_AT_EDGES + KernelInfo::MISSES_AT_VERTICES;
    EXPECT_LE(misses, std::ceil(1e-6 * promised * segments));
}

}  // namespace
}  // namespace bwfirt::test
