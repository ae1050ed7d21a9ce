// SPDX-License-Identifier: GPL-3.0-only
#include "render/ErrorView.h"

#include "render/FalseColour.h"
#include "render/Renderer.h"
#include "test/Shapes.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

/// Answers as another kernel does, except to rays that start on one side of the scene.
class WrongOnTheLeft : public RTKernel {
  public:
    WrongOnTheLeft(const RTKernel& kernel, std::optional<Difference> how)
        : kernel_(kernel), how_(how) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
        if (ray.direction.x > 0 || !how_)
            return hit;
        switch (*how_) {
            case Difference::MISSED:
                return std::nullopt;
            case Difference::GHOST:
                return hit ? hit : std::optional<Hit>({1, 0});
            case Difference::WRONG_TRIANGLE:
                return hit ? std::optional<Hit>({0.9F * hit->distance, hit->triangle ^ 1}) : hit;
            case Difference::TIE:
                return hit ? std::optional<Hit>({hit->distance, hit->triangle ^ 1}) : hit;
            default:
                return hit;
        }
    }
    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        const bool isVisible = kernel_.kernelVisibility(x, y);
        if (x.x > -0.2F)
            return isVisible;
        return (isVisible && how_ != Difference::FALSE_OCCLUDED) ||
               how_ == Difference::FALSE_VISIBLE;
    }

  private:
    const RTKernel& kernel_;
    std::optional<Difference> how_;
};

/// A wall with a hole around its centre, lit from behind the camera, black beyond.
class Errors : public testing::Test {
  protected:
    static constexpr int SIZE = 16;

    Errors() {
        const auto wall = [](float xLow, float xHigh, float yLow, float yHigh, float z) {
            return test::quad(V3f(xLow, yLow, z), V3f(xHigh, yLow, z), V3f(xHigh, yHigh, z),
                              V3f(xLow, yHigh, z));
        };
        scene.triangles =
            test::joined({wall(-2, 2, -2, 2, 1), wall(-9, 9, 0.2F, 9, -2),
                          wall(-9, 9, -9, -0.2F, -2), wall(-0.3F, 0.3F, 0.4F, 0.8F, -1)});
        scene.lights = {{0, 1, 10}};
        reference->kernelInitialize(scene.triangles);
    }

    /// The image after some passes.
    Film show(std::optional<Difference> how) {
        const WrongOnTheLeft kernel(*reference, how);
        const PathTracer pathTracer(scene, kernel, camera, SIZE, SIZE, 1);
        const FalseColour shade(View::EVEN_LIGHT, scene, kernel, camera, SIZE, SIZE, 1);
        const ErrorView errors(pathTracer, shade, *reference);
        Film film(SIZE, SIZE);
        for (int pass = 0; pass < 20; ++pass)
            Renderer(errors, 1, 2).renderPass(film);
        differences = errors.differences();
        return film;
    }

    static int pixelsOf(const Film& film, const V3d& colour) {
        int count = 0;
        for (int y = 0; y < SIZE; ++y)
            for (int x = 0; x < SIZE; ++x) {
                const V3d mean = film.mean(x, y);
                bool isColour = mean.x > 1 || mean.y > 1 || mean.z > 1;
                for (int channel = 0; channel < 3; ++channel)
                    isColour = isColour && (mean[channel] > 1) == (colour[channel] > 0);
                count += isColour ? 1 : 0;
            }
        return count;
    }

    std::uint64_t count(Difference kind) const {
        return differences[static_cast<std::size_t>(kind)];
    }

    Scene scene;
    Camera camera;
    std::unique_ptr<RTKernel> reference = createKernel();
    std::array<std::uint64_t, DIFFERENCE_NAMES.size()> differences{};
};

const V3d RED(1, 0, 0), YELLOW(1, 1, 0), CYAN(0, 1, 1);

TEST_F(Errors, ARightKernelHasNone) {
    const Film film = show(std::nullopt);
    EXPECT_EQ(differences, decltype(differences){});
    for (int y = 0; y < SIZE; ++y)
        for (int x = 0; x < SIZE; ++x) {
            EXPECT_LT(film.mean(x, y).x, 0.2);
            EXPECT_EQ(film.mean(x, y).x, film.mean(x, y).z);
        }
}

TEST_F(Errors, EachKindHasItsColourAndIsCounted) {
    for (const auto& [kind, colour] : {std::pair(Difference::MISSED, RED),
                                       {Difference::WRONG_TRIANGLE, RED},
                                       {Difference::GHOST, YELLOW},
                                       {Difference::FALSE_VISIBLE, CYAN},
                                       {Difference::FALSE_OCCLUDED, CYAN}}) {
        const Film film = show(kind);
        EXPECT_GT(count(kind), 0u) << DIFFERENCE_NAMES[static_cast<std::size_t>(kind)];
        EXPECT_GT(pixelsOf(film, colour), 5) << DIFFERENCE_NAMES[static_cast<std::size_t>(kind)];
        EXPECT_LT(pixelsOf(film, colour), SIZE * SIZE);
    }
}

TEST_F(Errors, ATieIsCountedButNoError) {
    const Film film = show(Difference::TIE);
    EXPECT_GT(count(Difference::TIE), 0u);
    EXPECT_EQ(pixelsOf(film, RED) + pixelsOf(film, YELLOW) + pixelsOf(film, CYAN), 0);
}

}  // namespace
}  // namespace bwfirt
