// SPDX-License-Identifier: GPL-3.0-only
#include "scene/FileIO.h"
#include "scene/Scene.h"
#include "test/fuzz/Fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bwfirt;
    const auto triangles = fuzz::readAsFile(data, size, readTriangles);
    if (!triangles)
        return 0;
    fuzz::require(36 * triangles->size() == size, "36 bytes are a triangle");

    Scene scene;
    scene.triangles = *triangles;
    for (const std::string& warning : sceneWarnings(scene))
        fuzz::requireOneLine(warning);

    writeTriangles(fuzz::folder() / "written", *triangles);
    fuzz::require(readTextFile(fuzz::folder() / "written") == std::string(data, data + size),
                  "written triangles are the bytes that were read");
    return 0;
}
