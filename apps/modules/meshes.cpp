#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "guarded.h"
#include "input/scene/meshes/module.h"

// OBJ, STL and PLY through libassimp. All steps but triangulation join, sort or move vertices.

namespace {

/// The only file that assimp can open, so that no file can make it open another. An .mtl is not
/// needed: usemtl names the materials.
class OneFile final : public Assimp::IOSystem {
  public:
    OneFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}

    bool Exists(const char* name) const override { return name_ == name; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char*) override {
        const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes_.data());
        return Exists(name) ? new Assimp::MemoryIOStream(begin, bytes_.size()) : nullptr;
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    std::string name_;
    std::string_view bytes_;
};

/// Keeps only the reader of `format`: assimp picks one by a file's name, but also by its content.
void keep_only(Assimp::Importer& importer, const char* format) {
    const std::size_t kept = importer.GetImporterIndex(format);
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        if (i == kept) continue;
        Assimp::BaseImporter* other = importer.GetImporter(i);
        importer.UnregisterLoader(other);
        delete other;
    }
}

std::string material_of(const aiScene& scene, const aiMesh& mesh) {
    if (mesh.mMaterialIndex >= scene.mNumMaterials) return "";
    const std::string name = scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    return name == AI_DEFAULT_MATERIAL_NAME ? "" : name;
}

/// The name of a node; "" if assimp made it up.
std::string name_of(const aiNode& node, std::string_view format) {
    const std::string name = node.mName.C_Str();
    const bool made_up =
        format == "ply" || name == "defaultobject" || name == "mesh.obj" || name.starts_with('<');
    return made_up ? "" : name;
}

void add_part(const aiScene& scene, const aiMesh& mesh, const std::string& node,
              SonarsimAddPart add, void* user) {
    std::vector<float> positions;
    positions.reserve(std::size_t{3} * mesh.mNumVertices);
    for (unsigned i = 0; mesh.mVertices != nullptr && i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    std::vector<std::uint32_t> corners;
    std::size_t others = mesh.mNumFaces == 0 ? 1 : 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices == 3)
            corners.insert(corners.end(), face.mIndices, face.mIndices + 3);
        else
            ++others;
    }
    const std::string material = material_of(scene, mesh);
    const SonarsimMeshPart part{node.c_str(),
                                material.c_str(),
                                positions.data(),
                                positions.size() / 3,
                                corners.data(),
                                corners.size() / 3,
                                others};
    add(user, &part);
}

void add_parts(const aiScene& scene, const aiNode& node, std::string_view format,
               SonarsimAddPart add, void* user) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        add_part(scene, *scene.mMeshes[node.mMeshes[i]], name_of(node, format), add, user);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        add_parts(scene, *node.mChildren[i], format, add, user);
}

/// Tells assimp the truth about its meshes: its PLY reader calls a face without corners a polygon,
/// and its triangulation then ends the program by an assertion.
void correct_types(const aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        aiMesh& mesh = *scene.mMeshes[m];
        mesh.mPrimitiveTypes = 0;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const unsigned corners = mesh.mFaces[i].mNumIndices;
            mesh.mPrimitiveTypes |= corners > 3    ? aiPrimitiveType_POLYGON
                                    : corners == 3 ? aiPrimitiveType_TRIANGLE
                                                   : aiPrimitiveType_LINE;
        }
    }
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_read_mesh_1(
    const char* format, const char* bytes, std::size_t size, SonarsimAddPart add, void* user,
    char* error, std::size_t error_size) {
    return guarded(error, error_size, [&] {
        Assimp::Importer importer;
        keep_only(importer, format);
        const std::string name = std::string("mesh.") + format;
        importer.SetIOHandler(new OneFile(name, {bytes, size}));  // the importer owns it
        const aiScene* scene = importer.ReadFile(name, 0);
        if (scene != nullptr) correct_types(*scene);
        if (scene != nullptr) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
        if (scene == nullptr || scene->mRootNode == nullptr)
            throw std::runtime_error(importer.GetErrorString());
        add_parts(*scene, *scene->mRootNode, format, add, user);
    });
}
