// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Outputs.h"

#include "scene/FileIO.h"
#include "tools/import/Conversion.h"

#include <stdlib.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace bwfirt {

namespace fs = std::filesystem;

namespace {

// The scene comes last: it names the triangles.
constexpr std::array EXTENSIONS = {".ra2", ".camera", ".scene"};

}  // namespace

Outputs::Outputs(const fs::path& base) : base_(base) {
    std::string name = base_.string() + ".XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error(base_.string() +
                                 ": cannot be written: " + std::generic_category().message(errno));
    folder_ = name;
}

Outputs::~Outputs() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

fs::path Outputs::target(const char* extension) const {
    return base_.string() + extension;
}

std::string Outputs::trianglesPath() const {
    return target(".ra2").filename().string();
}

fs::path Outputs::hidden(const char* extension) const {
    return folder_ / (base_.filename().string() + extension);
}

void Outputs::check(const fs::path& input) const {
    for (const char* extension : EXTENSIONS) {
        requireWritable(target(extension));
        if (std::error_code error; fs::equivalent(input, target(extension), error))
            throw std::runtime_error(input.string() + ": would be overwritten by the scene");
    }
    Scene empty;
    empty.trianglesPath = trianglesPath();
    writeScene(hidden(".scene"), empty);  // fails where a scene cannot name its triangles
}

void Outputs::write(Conversion& conversion, const std::string& comment) const {
    conversion.scene.trianglesPath = trianglesPath();
    try {
        writeTriangles(hidden(".ra2"), conversion.scene.triangles);
        writeCamera(hidden(".camera"), conversion.camera);
        writeScene(hidden(".scene"), conversion.scene, comment);
    } catch (const std::runtime_error& error) {  // the user knows the file by its own place
        std::string message = error.what();
        const std::string folder = folder_.filename().string() + "/";
        if (const std::size_t found = message.find(folder); found != std::string::npos)
            message.erase(found, folder.size());
        throw std::runtime_error(message);
    }
}

void Outputs::publish() const {
    // An old scene does not survive its triangles, whatever comes between.
    std::error_code none;
    fs::remove(target(".scene"), none);
    for (const char* extension : EXTENSIONS) {
        std::error_code error;
        fs::rename(hidden(extension), target(extension), error);
        if (error)
            throw std::runtime_error(target(extension).string() +
                                     ": cannot be written: " + error.message());
    }
}

}  // namespace bwfirt
