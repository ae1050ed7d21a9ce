// SPDX-License-Identifier: GPL-3.0-only

// Measures what the framework spends outside the kernel, per ray. A first rendering records the
// answers of a kernel; a second one, on the same rays in the same order, is answered from that
// recording, and its time is the framework's own, including the virtual calls and the reading of
// the recording. One thread, since the order of the rays is the index into the recording.

#include "kernel/RTKernel.h"
#include "render/PathTracer.h"
#include "render/Renderer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

using namespace bwfirt;

constexpr int WIDTH = 320, HEIGHT = 240, REPEATS = 9;
constexpr std::uint64_t SEED = 1;

struct Answers {
    std::vector<std::optional<Hit>> hits;
    std::vector<char> visible;
};

class Recorder : public RTKernel {
  public:
    Recorder(const RTKernel& kernel, Answers& answers) : kernel_(kernel), answers_(answers) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray& ray) const override {
        answers_.hits.push_back(kernel_.kernelIntersectGeometry(ray));
        return answers_.hits.back();
    }
    bool kernelVisibility(const V3f& x, const V3f& y) const override {
        answers_.visible.push_back(kernel_.kernelVisibility(x, y) ? 1 : 0);
        return answers_.visible.back() != 0;
    }

  private:
    const RTKernel& kernel_;
    Answers& answers_;
};

class Player : public RTKernel {
  public:
    explicit Player(const Answers& answers)
        : nextHit_(answers.hits.data()), nextVisible_(answers.visible.data()) {}
    void kernelInitialize(std::span<const Triangle>) override {}
    std::optional<Hit> kernelIntersectGeometry(const Ray&) const override { return *nextHit_++; }
    bool kernelVisibility(const V3f&, const V3f&) const override { return *nextVisible_++ != 0; }

  private:
    mutable const std::optional<Hit>* nextHit_;
    mutable const char* nextVisible_;
};

struct Rendering {
    RayCounts counts;
    std::chrono::duration<double, std::nano> time;
};

/// One pass, timed without the making of the film, as the passes of a run are.
Rendering render(const Scene& scene, const Camera& camera, const RTKernel& kernel) {
    const PathTracer pathTracer(scene, kernel, camera, WIDTH, HEIGHT, 1);
    Film film(WIDTH, HEIGHT);
    const auto start = std::chrono::steady_clock::now();
    const RayCounts counts = Renderer(pathTracer, SEED, 1).renderPass(film);
    return {counts, std::chrono::steady_clock::now() - start};
}

void measure(const char* scenePath, const char* cameraPath) {
    const Scene scene = readScene(scenePath);
    const Camera camera = readCamera(cameraPath);
    const std::unique_ptr<RTKernel> kernel = createKernel();
    kernel->kernelInitialize(scene.triangles);
    Answers answers;
    const RayCounts counts = render(scene, camera, Recorder(*kernel, answers)).counts;
    const auto rays = static_cast<double>(counts.intersect + counts.visibility);

    std::vector<double> nanoseconds;
    for (int i = 0; i < REPEATS; ++i)
        nanoseconds.push_back(render(scene, camera, Player(answers)).time.count() / rays);
    std::sort(nanoseconds.begin(), nanoseconds.end());
    std::printf("%.0f rays, framework: median %.1f ns per ray, from %.1f to %.1f in %d repeats\n",
                rays, nanoseconds[REPEATS / 2], nanoseconds.front(), nanoseconds.back(), REPEATS);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: framework-cost SCENE CAMERA\n");
        return 2;
    }
    try {
        measure(argv[1], argv[2]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "framework-cost: %s\n", error.what());
        return 1;
    }
}
