// SPDX-License-Identifier: GPL-3.0-only
#include "test/conformance/Conformance.h"

namespace bwfirt::test {

namespace {

/// Asks a kernel every fourth question twice, alone and in flight, and wants the same answer.
class InBothModes : public RTKernel {
  public:
    explicit InBothModes(std::unique_ptr<RTKernel> kernel) : kernel_(std::move(kernel)) {}

    void kernelInitialize(std::span<const Triangle> triangles) override {
        kernel_->kernelInitialize(triangles);
    }

    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const std::optional<Hit> hit = kernel_->kernelIntersectGeometry(ray);
        if (!isTurn())
            return hit;
        std::optional<Hit> inFlight;
        kernel_->kernelIntersectMany({&ray, 1}, {&inFlight, 1});
        if (!areSame(hit, inFlight))
            ADD_FAILURE() << "another hit in flight: from " << ray.origin << " along "
                          << ray.direction;
        return hit;
    }

    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const bool isVisible = kernel_->kernelVisibility(x, y);
        if (!isTurn())
            return isVisible;
        const Segment segment{x, y};
        bool isVisibleInFlight = !isVisible;
        kernel_->kernelVisibleMany({&segment, 1}, {&isVisibleInFlight, 1});
        if (isVisible != isVisibleInFlight)
            ADD_FAILURE() << "another visibility in flight: between " << x << " and " << y;
        return isVisible;
    }

    void kernelIntersectMany(std::span<const Ray> rays,
                             std::span<std::optional<Hit>> hits) const override {
        kernel_->kernelIntersectMany(rays, hits);
    }

    void kernelVisibleMany(std::span<const Segment> segments,
                           std::span<bool> visible) const override {
        kernel_->kernelVisibleMany(segments, visible);
    }

  private:
    static bool isTurn() {
        thread_local unsigned questions = 0;
        return questions++ % 4 == 0;
    }

    std::unique_ptr<RTKernel> kernel_;
};

}  // namespace

std::unique_ptr<RTKernel> kernelFor(const Triangles& triangles) {
    auto kernel = std::make_unique<InBothModes>(createKernel());
    kernel->kernelInitialize(triangles);
    return kernel;
}

bool areSame(const std::optional<Hit>& one, const std::optional<Hit>& other) {
    if (!one || !other)
        return one.has_value() == other.has_value();
    return one->distance == other->distance && one->triangle == other->triangle;
}

Ray towards(const V3f& origin, const V3f& target) {
    return {origin, V3f((V3d(target) - V3d(origin)).normalized())};
}

V3f RandomPoints::next() {
    const double x = uniform_(random_), y = uniform_(random_), z = uniform_(random_);
    return V3f(V3d(centre_) + size_ * V3d(x, y, z));
}

V3d pointInside(const Triangle& triangle, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0.01, 1);
    const double a = uniform(random), b = uniform(random), c = uniform(random);
    const auto& vertices = triangle.vertices;
    return (a * V3d(vertices[0]) + b * V3d(vertices[1]) + c * V3d(vertices[2])) / (a + b + c);
}

V3f movedOff(const Triangle& triangle, const V3d& point, double side) {
    return V3f(point + side * RTKernel::NORMAL_OFFSET * unitNormal(triangle));
}

Triangles grid() {
    Triangles triangles;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
            triangles = joined({triangles, quad(V3f(x, y, 0), V3f(x + 1, y, 0),
                                                V3f(x + 1, y + 1, 0), V3f(x, y + 1, 0))});
    return triangles;
}

void expectRightAnswers(const Triangles& triangles, const V3f& centre, double size, int queries) {
    const auto kernel = kernelFor(triangles);
    const Oracle oracle(triangles);
    RandomPoints points(centre, size);
    int wrong = 0;
    for (int i = 0; i < queries; ++i) {
        const V3f x = points.next(), y = points.next();
        const Ray ray = towards(x, y);
        const auto hit = oracle.accepts(ray, kernel->kernelIntersectGeometry(ray));
        const auto visible = oracle.accepts(x, y, kernel->kernelVisibility(x, y));
        if (hit && visible)
            continue;
        if (++wrong == 1) {
            EXPECT_TRUE(hit) << "ray from " << x << " along " << ray.direction;
            EXPECT_TRUE(visible) << "between " << x << " and " << y;
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << queries << " pairs of queries";
}

}  // namespace bwfirt::test
