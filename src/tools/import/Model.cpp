// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Model.h"

#include "scene/TextReader.h"
#include "tools/import/Apart.h"
#include "tools/import/GltfTriangles.h"
#include "tools/import/ModelCamera.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>

#include <new>
#include <stdexcept>

namespace bwfirt {

namespace {

using Matrix = aiMatrix4x4t<double>;

/// A model may name other files. A FIFO or a device among them would never end. Each file brings
/// the time that reading it may take; damaged ones let some readers loop for ever.
class RegularFiles : public Assimp::DefaultIOSystem {
  public:
    bool Exists(const char* path) const override {
        std::error_code error;
        return std::filesystem::is_regular_file(path, error);
    }

    Assimp::IOStream* Open(const char* path, const char* mode) override {
        if (!Exists(path))
            return nullptr;
        std::error_code error;
        const std::uintmax_t bytes = std::filesystem::file_size(path, error);
        limitProcessorTime(10 + (error ? 0 : bytes / 500'000));  // several times what is needed
        return DefaultIOSystem::Open(path, mode);
    }
};

constexpr std::size_t LONGEST_COMPLAINT = 200;

/// Keeps warnings and errors, each without the level and thread that come before ": ".
class Complaints : public Assimp::LogStream {
  public:
    explicit Complaints(std::vector<std::string>& kept) : kept_(kept) {}

    void write(const char* message) override {
        const std::string_view text = message;
        const std::size_t colon = text.find(": ");
        std::string line(text.substr(colon == std::string_view::npos ? 0 : colon + 2));
        if (line.ends_with('\n'))
            line.pop_back();
        kept_.push_back(printable(line, LONGEST_COMPLAINT));
    }

  private:
    std::vector<std::string>& kept_;
};

/// As long as it lives, assimp's log goes to Complaints.
class Logging {
  public:
    explicit Logging(std::vector<std::string>& kept) : complaints_(kept) {
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
        Assimp::DefaultLogger::get()->attachStream(&complaints_, LEVELS);
    }
    ~Logging() {
        Assimp::DefaultLogger::get()->detachStream(&complaints_, LEVELS);
        Assimp::DefaultLogger::kill();
    }
    Logging(const Logging&) = delete;
    Logging& operator=(const Logging&) = delete;

  private:
    static constexpr unsigned LEVELS = Assimp::Logger::Warn | Assimp::Logger::Err;
    Complaints complaints_;
};

/// Rec. 709 luminance of what the material emits.
Material converted(const aiMaterial& source) {
    aiColor3D colour(0, 0, 0);
    float intensity = 1;
    source.Get(AI_MATKEY_COLOR_EMISSIVE, colour);
    source.Get(AI_MATKEY_EMISSIVE_INTENSITY, intensity);
    Material material;
    material.name = source.GetName().C_Str();
    material.radiance = intensity * (0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b);
    material.hasTexture = source.GetTextureCount(aiTextureType_EMISSIVE) > 0 ||
                          source.GetTextureCount(aiTextureType_EMISSION_COLOR) > 0;
    return material;
}

std::string formatName(const aiScene& scene) {
    aiString name;
    if (scene.mMetaData != nullptr)
        scene.mMetaData->Get("SourceAsset_Format", name);
    return name.C_Str();
}

/// The file's own axis. The reader of FBX tells it and that of Blender leaves z as it is; the
/// others turn their scenes to y, or read formats that have no axis of their own.
V3d upAxis(const aiScene& scene) {
    int axis = formatName(scene).starts_with("Blender") ? 2 : 1, sign = 1;
    if (scene.mMetaData != nullptr && scene.mMetaData->Get("UpAxis", axis))
        scene.mMetaData->Get("UpAxisSign", sign);
    V3d up(0);
    up[axis >= 0 && axis <= 2 ? axis : 1] = sign < 0 ? -1 : 1;
    return up;
}

void requireGltfTriangles(const std::filesystem::path& path, const aiScene& scene) {
    std::uint64_t count = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i)
        for (unsigned j = 0; j < scene.mMeshes[i]->mNumFaces; ++j)
            count += scene.mMeshes[i]->mFaces[j].mNumIndices == 3;
    const std::uint64_t announced = announcedGltfTriangles(path);
    if (count < announced)
        throw std::runtime_error(path.string() + ": " + std::to_string(announced - count) +
                                 " of its " + std::to_string(announced) +
                                 " triangles refer to vertices that are not there");
}

struct Instance {
    const aiNode* node;
    Matrix transform;
};

/// Calls for every mesh of every node with the transform to the root. Not by recursion, which a
/// deep hierarchy would bring to the end of the stack.
template <typename Visit>
void forEachInstance(const aiScene& scene, const Visit& visit) {
    std::vector<Instance> stack = {{scene.mRootNode, Matrix()}};
    while (!stack.empty()) {
        const Instance parent = stack.back();
        stack.pop_back();
        const aiNode& node = *parent.node;
        const Matrix transform = parent.transform * static_cast<Matrix>(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            if (node.mMeshes[i] < scene.mNumMeshes)
                visit(*scene.mMeshes[node.mMeshes[i]], transform);
        for (unsigned i = node.mNumChildren; i > 0; --i)
            stack.push_back({node.mChildren[i - 1], transform});
    }
}

}  // namespace

struct Model::Import {
    Assimp::Importer importer;
    const aiScene* scene = nullptr;
};

Model::Model(const std::filesystem::path& path)
    : path_(path.string()), import_(std::make_unique<Import>()) {
    const Logging logging(complaints_);
    Assimp::Importer& importer = import_->importer;
    importer.SetIOHandler(new RegularFiles);  // which becomes the importer's own
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    const aiScene* scene = importer.ReadFile(path_, aiProcess_Triangulate);
    if (scene == nullptr || scene->mRootNode == nullptr) {
        std::string reason = importer.GetErrorString();
        if (reason.find("bad_alloc") != std::string::npos)
            throw std::bad_alloc();
        if (reason.starts_with("No suitable reader"))
            reason = "is of no format that assimp reads";
        throw std::runtime_error(
            path_ + ": " +
            printable(reason.empty() ? "cannot be read" : reason, LONGEST_COMPLAINT));
    }
    liftProcessorTimeLimit();
    import_->scene = scene;
    format_ = formatName(*scene);
    up_ = upAxis(*scene);
    if (format_.starts_with("glTF2"))
        requireGltfTriangles(path, *scene);
    camera_ = firstCamera(*scene, format_);
    for (unsigned i = 0; i < scene->mNumMaterials; ++i)
        materials_.push_back(converted(*scene->mMaterials[i]));
}

Model::~Model() = default;

void Model::forEachTriangle(const std::function<void(const Corners&, std::size_t)>& visit) const {
    forEachInstance(*import_->scene, [&](const aiMesh& mesh, const Matrix& transform) {
        const auto corner = [&](unsigned index) {
            if (index >= mesh.mNumVertices)
                throw std::runtime_error(path_ + ": a face refers to vertex " +
                                         std::to_string(index) + " of a mesh of " +
                                         std::to_string(mesh.mNumVertices) + " vertices");
            const auto point = transform * aiVector3t<double>(mesh.mVertices[index]);
            return V3d(point.x, point.y, point.z);
        };
        for (unsigned i = 0; i < mesh.mNumFaces; ++i)
            if (const aiFace& face = mesh.mFaces[i]; face.mNumIndices == 3)
                visit(
                    {corner(face.mIndices[0]), corner(face.mIndices[1]), corner(face.mIndices[2])},
                    mesh.mMaterialIndex);
    });
}

std::size_t Model::pointsAndLines() const {
    std::size_t count = 0;
    forEachInstance(*import_->scene, [&](const aiMesh& mesh, const Matrix&) {
        for (unsigned i = 0; i < mesh.mNumFaces; ++i)
            count += mesh.mFaces[i].mNumIndices != 3;
    });
    return count;
}

std::size_t Model::lightSources() const {
    return import_->scene->mNumLights;
}

}  // namespace bwfirt
