// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/LiveRenderer.h"

#include "render/Renderer.h"
#include "test/Shapes.h"
#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace bwfirt {
namespace {

using namespace std::chrono_literals;

constexpr int WIDTH = 80, HEIGHT = 60;
const Light LAMP{0, 1, 10};

/// Polls until it is so.
template <typename Condition>
void waitUntil(const Condition& isSo) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!isSo()) {
        if (std::chrono::steady_clock::now() > end)
            throw std::logic_error("has not come within a minute");
        std::this_thread::sleep_for(1ms);
    }
}

/// A box, seen from inside, with two of its triangles as lights.
class LiveRendering : public testing::Test {
  protected:
    LiveRendering() {
        scene.trianglesPath = "box.ra2";
        scene.triangles = test::box(V3f(-1), V3f(1));
        scene.lights = {LAMP};
        settings.scene = folder / "box.scene";
        settings.threads = 2;
        settings.passes = 3;
        writeTriangles(folder / "box.ra2", scene.triangles);
        writeScene(settings.scene, scene);
        wish.width = WIDTH;
        wish.height = HEIGHT;
        wish.lights = scene.lights;
    }

    std::unique_ptr<LiveRenderer> start(std::unique_ptr<RTKernel> kernel = createKernel()) {
        auto renderer = std::make_unique<LiveRenderer>(settings, std::move(kernel));
        waitUntil([&] { return renderer->isReady(); });
        return renderer;
    }

    /// A picture of this wish after so many passes at full resolution, or more.
    std::shared_ptr<const Picture> pictureOf(LiveRenderer& renderer, int passes) {
        std::shared_ptr<const Picture> picture;
        waitUntil([&] {
            picture = renderer.picture();
            return picture && picture->wish == wish && picture->width == WIDTH &&
                   !picture->isPreview && picture->passes >= passes;
        });
        return picture;
    }

    test::TemporaryFolder folder;
    Scene scene;
    Settings settings;
    Wish wish;
};

TEST_F(LiveRendering, GivesTheImageOfABatchRunToTheBit) {
    const auto renderer = start();
    renderer->show(wish);
    const auto picture = pictureOf(*renderer, settings.passes);

    const auto kernel = createKernel();
    kernel->kernelInitialize(scene.triangles);
    Film film(WIDTH, HEIGHT);
    const PathTracer pathTracer(scene, *kernel, wish.camera, WIDTH, HEIGHT, 1);
    for (int pass = 0; pass < settings.passes; ++pass)
        Renderer(pathTracer, settings.seed, 1).renderPass(film);
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            EXPECT_EQ(picture->pixels[static_cast<std::size_t>(y * WIDTH + x)],
                      V3f(film.mean(x, y)));
}

TEST_F(LiveRendering, ANewWishReplacesTheOneBefore) {
    const auto renderer = start();
    renderer->show(wish);
    const auto before = pictureOf(*renderer, settings.passes);
    wish.camera.direction = V3d(1, 0, 0);
    renderer->show(wish);
    const auto after = pictureOf(*renderer, settings.passes);
    EXPECT_NE(before->pixels, after->pixels);
}

TEST_F(LiveRendering, AMovedCameraShowsAnEvenLightFirst) {
    const auto renderer = start();
    renderer->show(wish);
    const auto before = pictureOf(*renderer, settings.passes);
    std::shared_ptr<const Picture> first;
    // The preview may be gone before anybody looks.
    for (int i = 1; !first || !first->isPreview; ++i) {
        ASSERT_LT(i, 1000);
        wish.camera.position.x = i / 2000.0;
        renderer->show(wish);
        waitUntil([&] {
            first = renderer->picture();
            return first->wish == wish;
        });
    }
    EXPECT_TRUE(first->isFirst);
    const auto mean = [](const Picture& picture) {
        double sum = 0;
        for (const V3f& pixel : picture.pixels)
            sum += std::min(pixel.x, 1.F) / static_cast<double>(picture.pixels.size());
        return sum;
    };
    EXPECT_NEAR(mean(*first), mean(*before), 0.2 * mean(*before)) << "as bright as the light";
    const auto last = pictureOf(*renderer, settings.passes);
    EXPECT_FALSE(last->isPreview);
    EXPECT_EQ(last->view, std::nullopt);
}

TEST_F(LiveRendering, ManyWishesInARowEndInAPictureOfTheLast) {
    const auto renderer = start();
    for (int i = 0; i < 200; ++i) {
        wish.camera.position.x = i / 400.0;
        wish.view = i % 3 == 0 ? std::optional(View::NORMALS) : std::nullopt;
        wish.lights = {{0, static_cast<std::uint32_t>(i % 12), 1.0 + i}};
        renderer->show(wish);
        if (i % 10 == 0)
            std::this_thread::sleep_for(2ms);
    }
    EXPECT_EQ(pictureOf(*renderer, settings.passes)->wish, wish);
}

TEST_F(LiveRendering, APauseHoldsThePassesButNotTheFirst) {
    settings.passes = 1000000;
    const auto renderer = start();
    renderer->setPaused(true);
    renderer->show(wish);
    pictureOf(*renderer, 1);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(renderer->picture()->passes, 1);
    renderer->setPaused(false);
    waitUntil([&] { return renderer->picture()->passes > 1; });
}

TEST_F(LiveRendering, WithoutLightsAnEvenLightShowsTheScene) {
    const auto renderer = start();
    wish.lights.clear();
    for (const auto view : {std::optional<View>(), std::optional(View::QUERIES)}) {
        wish.view = view;
        renderer->show(wish);
        const auto picture = pictureOf(*renderer, 1);
        EXPECT_EQ(picture->view, View::EVEN_LIGHT);
        for (const V3f& pixel : picture->pixels)
            EXPECT_GT(pixel.x, 0) << "the box is closed";
    }
}

TEST_F(LiveRendering, WithoutTheReferenceErrorsAreAProblemThatIsTold) {
    const auto renderer = start();  // no library lies beside the test program
    wish.view = View::ERRORS;
    renderer->show(wish);
    const auto picture = pictureOf(*renderer, 1);
    EXPECT_NE(picture->problem.find("libbwfirt-reference.so"), std::string::npos);
    EXPECT_EQ(picture->view, View::EVEN_LIGHT);
}

TEST_F(LiveRendering, ABadSceneIsAnErrorForTheCaller) {
    folder.write("box.scene", "triangles none.ra2\n");
    const LiveRenderer renderer(settings, createKernel());
    EXPECT_THROW(waitUntil([&] { return renderer.isReady(); }), std::runtime_error);
}

/// Answers so slowly that no pass ends.
class Sleeper : public RTKernel {
  public:
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray&) const override {
        if (isAsleep) {
            ++asked;
            std::this_thread::sleep_for(20ms);
        }
        return std::nullopt;
    }

    inline static std::atomic<bool> isAsleep = false;
    inline static std::atomic<int> asked = 0;  // is read when the kernel is gone
};

TEST_F(LiveRendering, EndsInTheMiddleOfAPass) {
    auto renderer = start(std::make_unique<Sleeper>());
    Sleeper::isAsleep = true;
    renderer->show(wish);
    waitUntil([] { return Sleeper::asked > 0; });
    renderer.reset();
    EXPECT_LT(Sleeper::asked, 500) << "the first pass asks 1200 times";
}

}  // namespace
}  // namespace bwfirt
