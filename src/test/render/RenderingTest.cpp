// SPDX-License-Identifier: GPL-3.0-only
#include "render/FalseColour.h"
#include "render/PathTracer.h"
#include "render/Renderer.h"
#include "test/Shapes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numbers>
#include <thread>

namespace bwfirt {
namespace {

std::unique_ptr<RTKernel> kernelFor(const Scene& scene) {
    std::unique_ptr<RTKernel> kernel = createKernel();
    kernel->kernelInitialize(scene.triangles);
    return kernel;
}

struct ImageSettings {
    int width = 16;
    int height = 16;
    int passes = 16;
    int threads = 2;
    int inFlight = 1;
    std::uint64_t seed = 1;
};

Film render(const Scene& scene, const Camera& camera, const RTKernel& kernel,
            const ImageSettings& settings) {
    const PathTracer pathTracer(scene, kernel, camera, settings.width, settings.height,
                                settings.inFlight);
    const Renderer renderer(pathTracer, settings.seed, settings.threads);
    Film film(settings.width, settings.height);
    for (int pass = 0; pass < settings.passes; ++pass)
        renderer.renderPass(film);
    return film;
}

std::vector<std::pair<int, int>> pixelsThatDiffer(const Film& a, const Film& b) {
    std::vector<std::pair<int, int>> pixels;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            if (a.mean(x, y) != b.mean(x, y))
                pixels.emplace_back(x, y);
    return pixels;
}

Scene furnace(double reflectance) {
    Scene scene;
    scene.triangles = test::sphere(V3f(0), 2, 1, 0);
    const auto last = static_cast<std::uint32_t>(scene.triangles.size() - 1);
    scene.lights = {{0, last, std::numbers::pi}};
    scene.reflectance = reflectance;
    return scene;
}

class Furnace : public testing::TestWithParam<double> {};

// Within a closed surface that emits L = 1 everywhere, all light that a point reflects comes from
// points that look alike: radiance = L + reflectance * radiance = L / (1 - reflectance).
TEST_P(Furnace, HasTheRadianceOfItsClosedForm) {
    const Scene scene = furnace(GetParam());
    const Film film = render(scene, Camera{}, *kernelFor(scene), {.passes = 64});
    const double expected = 1 / (1 - GetParam());
    // The offset of 1e-4 takes about that much of the light away from each edge.
    const double offsetBias = 1e-3 * expected;
    EXPECT_NEAR(film.averageIntensity().x, expected, 4 * film.standardError().x + offsetBias);
    EXPECT_LT(film.standardError().x, 0.02 * expected) << "too noisy to tell anything";
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Furnace, testing::Values(0, 0.3, 0.7, 0.9));

/// A floor under two square lights that face it, of different size, height and exitance.
struct SquareLight {
    V3d centre;
    double side;
    double exitance;
};
constexpr double FLOOR = 20, DARK = 0.01;
const std::vector<SquareLight> SQUARE_LIGHTS = {{V3d(-1, 2, 0), 1, 10}, {V3d(2, 3, 1), 0.5, 90}};

Scene floorWithLights() {
    Scene scene;
    scene.reflectance = DARK;
    scene.triangles = test::quad(V3f(-FLOOR, 0, -FLOOR), V3f(FLOOR, 0, -FLOOR),
                                 V3f(FLOOR, 0, FLOOR), V3f(-FLOOR, 0, FLOOR));
    for (const auto& [centre, side, exitance] : SQUARE_LIGHTS) {
        const auto first = static_cast<std::uint32_t>(scene.triangles.size());
        const V3f c(centre), x(static_cast<float>(side / 2), 0, 0), z(0, 0, x.x);
        scene.triangles =
            test::joined({scene.triangles, test::quad(c - x - z, c + x - z, c + x + z, c - x + z)});
        scene.lights.push_back({first, first + 1, exitance});
    }
    return scene;
}

/// Direct light that the floor reflects upwards at (x, 0, z), by the midpoint rule.
double reflectedAt(double x, double z) {
    constexpr int STEPS = 32;
    double irradiance = 0;
    for (const auto& [centre, side, exitance] : SQUARE_LIGHTS) {
        const double step = side / STEPS;
        for (int i = 0; i < STEPS; ++i) {
            for (int j = 0; j < STEPS; ++j) {
                const double dx = centre.x - side / 2 + (i + 0.5) * step - x;
                const double dz = centre.z - side / 2 + (j + 0.5) * step - z;
                const double squared = dx * dx + dz * dz + centre.y * centre.y;
                irradiance += exitance / std::numbers::pi * centre.y * centre.y /
                              (squared * squared) * step * step;
            }
        }
    }
    return DARK / std::numbers::pi * irradiance;
}

TEST(PathTracer, TwoLightsGiveTheDirectLightOfQuadrature) {
    const Scene scene = floorWithLights();
    Camera camera;  // looks down on the square [-1, 1]^2 of the floor
    camera.position = V3d(0, 1, 0);
    camera.direction = V3d(0, -1, 0);
    camera.up = V3d(0, 0, -1);
    camera.filmSizeY = 2;
    camera.sensorResponse = 3;
    constexpr int STEPS = 20;
    double expected = 0;
    for (int i = 0; i < STEPS; ++i)
        for (int j = 0; j < STEPS; ++j)
            expected += camera.sensorResponse *
                        reflectedAt(-1 + (i + 0.5) * 2 / STEPS, -1 + (j + 0.5) * 2 / STEPS) /
                        (STEPS * STEPS);

    const Film film = render(scene, camera, *kernelFor(scene), {.passes = 200});
    // What the lights reflect back to the dark floor is less than its reflectance of the whole.
    const double indirect = DARK * expected / 4;
    EXPECT_NEAR(film.averageIntensity().x, expected, 4 * film.standardError().x + indirect);
    EXPECT_LT(film.standardError().x, 0.005 * expected) << "too noisy to tell anything";
}

class Determinism : public testing::Test {
  protected:
    Determinism() {
        scene.triangles =
            test::joined({test::box(V3f(-2), V3f(2)), test::sphere(V3f(0, -1, 0), 0.7, 1, 0.1)});
        scene.lights = {{2, 3, 5}};
        camera.position = V3d(0, 0, 1.8);
        kernel = kernelFor(scene);
        image = std::make_unique<Film>(render(scene, camera, *kernel, settings));
    }

    Scene scene;
    Camera camera;
    ImageSettings settings{70, 40, 3, 1, 1, 1};
    std::unique_ptr<RTKernel> kernel;
    std::unique_ptr<Film> image;
};

TEST_F(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
    for (const int threads : {2, 5}) {
        settings.threads = threads;
        const Film other = render(scene, camera, *kernel, settings);
        EXPECT_TRUE(pixelsThatDiffer(*image, other).empty()) << threads << " threads";
        EXPECT_EQ(other.averageIntensity(), image->averageIntensity());
        EXPECT_EQ(other.standardError(), image->standardError());
    }
}

TEST_F(Determinism, AnyNumberOfPathsInFlightGivesTheSameBits) {
    for (const int inFlight : {2, 16, 64, PathTracer::MAX_IN_FLIGHT}) {
        settings.inFlight = inFlight;
        EXPECT_TRUE(pixelsThatDiffer(*image, render(scene, camera, *kernel, settings)).empty())
            << inFlight << " in flight";
    }
}

TEST_F(Determinism, AnotherSeedGivesAnotherImage) {
    settings.seed = 2;
    EXPECT_GT(pixelsThatDiffer(*image, render(scene, camera, *kernel, settings)).size(), 1000u);
}

/// A kernel that answers one query wrongly: the n-th that it is asked.
class Liar : public RTKernel {
  public:
    Liar(const RTKernel& kernel, std::uint64_t wrong) : kernel_(kernel), wrong_(wrong) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        const std::optional<Hit> hit = kernel_.kernelIntersectGeometry(ray);
        if (asked_++ != wrong_)
            return hit;
        return hit ? std::nullopt : std::optional<Hit>({1, 0});
    }
    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        return kernel_.kernelVisibility(x, y) != (asked_++ == wrong_);
    }

  private:
    const RTKernel& kernel_;
    std::uint64_t wrong_;
    mutable std::atomic<std::uint64_t> asked_{0};
};

TEST_F(Determinism, AWrongAnswerChangesItsOwnPathOnly) {
    std::size_t changed = 0;
    for (const std::uint64_t wrong : {0, 500, 5000, 20001, 20002, 20003}) {
        const Film other = render(scene, camera, Liar(*kernel, wrong), settings);
        const std::size_t pixels = pixelsThatDiffer(*image, other).size();
        EXPECT_LE(pixels, 1u);
        changed += pixels;
    }
    EXPECT_GE(changed, 4u) << "hardly any of the wrong answers mattered";
}

/// Throws on one query, as a kernel does that runs out of memory.
class Thrower : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray&) const override {
        throw std::bad_alloc();
    }
};

TEST_F(Determinism, AnExceptionOfAKernelReachesTheCaller) {
    EXPECT_THROW(render(scene, camera, Thrower(), settings), std::bad_alloc);
}

TEST(FalseColour, ShowsNormalsTurnedToTheViewerAndDistances) {
    Scene scene;  // a wall at z = -3, seen from both sides, with a diagonal of 2
    const float half = 1 / std::sqrt(2.0F);
    scene.triangles = test::quad(V3f(-half, -half, -3), V3f(half, -half, -3), V3f(half, half, -3),
                                 V3f(-half, half, -3));
    const auto kernel = kernelFor(scene);
    const auto centre = [&](View view, const Camera& camera) {
        const FalseColour integrator(view, scene, *kernel, camera, 1, 1,
                                     boundsOf(scene).size().length());
        Film film(1, 1);
        const RayCounts counts = Renderer(integrator, 1, 1).renderPass(film);
        EXPECT_EQ(counts.intersect, 1u);
        return film.mean(0, 0);
    };
    Camera front;
    front.filmSizeY = 0.001;
    Camera behind = front;
    behind.position = V3d(0, 0, -6);
    behind.direction = V3d(0, 0, 1);
    EXPECT_EQ(centre(View::NORMALS, front), V3d(0.5, 0.5, 1));
    EXPECT_NEAR((centre(View::NORMALS, behind) - V3d(0.5, 0.5, 0)).length(), 0, 1e-15);
    EXPECT_NEAR(centre(View::DISTANCE, front).x, 0.984, 1e-9) << "beyond the diagonal";
    EXPECT_NE(centre(View::TRIANGLES, front), V3d(0));
    front.direction = V3d(0, 0, 1);
    EXPECT_EQ(centre(View::NORMALS, front), V3d(0)) << "black where there is nothing";
}

TEST(FalseColour, EvenLightIsTheReflectanceWhereASurfaceIsSeenFromTheFront) {
    Scene scene;
    scene.triangles = test::quad(V3f(-9, -9, -3), V3f(9, -9, -3), V3f(9, 9, -3), V3f(-9, 9, -3));
    const auto kernel = kernelFor(scene);
    const auto centre = [&](const V3d& direction) {
        Camera camera;
        camera.direction = direction;
        camera.filmSizeY = 0.001;
        Film film(1, 1);
        Renderer(FalseColour(View::EVEN_LIGHT, scene, *kernel, camera, 1, 1, 1), 1, 1)
            .renderPass(film);
        return film.mean(0, 0).x;
    };
    EXPECT_NEAR(centre(V3d(0, 0, -1)), 0.7, 1e-6);
    EXPECT_NEAR(centre(V3d(1, 0, -1)), 0.7 * std::sqrt(0.5), 1e-3);
    EXPECT_EQ(centre(V3d(0, 0, 1)), 0);
}

/// Takes its time.
class Slow : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray&) const override {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return std::nullopt;
    }
};

TEST(FalseColour, TimeIsTheSecondsOfH) {
    const Scene scene;
    Film film(2, 2);
    const RayCounts counts =
        Renderer(FalseColour(View::TIME, scene, Slow(), {}, 2, 2, 1), 1, 1).renderPass(film);
    EXPECT_EQ(counts.intersect, 4u);
    EXPECT_GE(film.averageIntensity().x, 0.002);
    EXPECT_LT(film.averageIntensity().x, 60);
}

}  // namespace
}  // namespace bwfirt
