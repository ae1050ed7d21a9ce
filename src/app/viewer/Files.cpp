// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Files.h"

#include "scene/FileIO.h"

namespace bwfirt {

namespace fs = std::filesystem;

fs::path newFile(const fs::path& scene, const std::string& ending) {
    for (int number = 1;; ++number) {
        const fs::path path = scene.stem().string() + "-" + std::to_string(number) + ending;
        if (!fs::exists(path))
            return path;
    }
}

fs::path saveLights(const fs::path& scene, const std::vector<Light>& lights) {
    const std::string old = readTextFile(scene);
    const fs::path target = fs::canonical(scene);  // a link stays one
    fs::path backup = target.string() + ".bak";
    for (int number = 2; fs::exists(backup); ++number)
        backup = target.string() + ".bak" + std::to_string(number);
    writeFileAtomically(backup, old);
    try {
        writeLights(target, lights);
    } catch (...) {
        fs::remove(backup);
        throw;
    }
    return backup;
}

}  // namespace bwfirt
