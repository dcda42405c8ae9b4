#include "input/scene/meshes/read_mesh.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/module.h"
#include "core/text.h"
#include "input/scene/meshes/module.h"
#include "input/scene/meshes/whole_file.h"
#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_mesh_bytes = std::size_t{1} << 31;

/// "stl" for "Hull.STL".
std::string format_of(const std::filesystem::path& path) {
    const std::string extension = in_lower_case(path.extension().string());
    return extension.empty() ? "" : extension.substr(1);
}

/// Makes a model of the parts of a file.
class ModelBuilder {
  public:
    explicit ModelBuilder(const std::filesystem::path& path)
        : title_(printable(path.stem().string())) {}

    void add(const SonarsimMeshPart& part) {
        // Files may have names in any encoding; those of a dataset are UTF-8.
        const std::string name = printable(part.node);
        const int mesh = mesh_of(name.empty() ? title_ : name);
        if (part.triangles > 0) {
            const int positions =
                add_positions(model_, {part.positions, part.positions + 3 * part.vertices});
            add_triangles(model_, mesh, positions,
                          {part.corners, part.corners + 3 * part.triangles},
                          material_number(model_, printable(part.material)));
        }
        if (part.others == 0) return;
        auto& primitives = model_.meshes[static_cast<std::size_t>(mesh)].primitives;
        primitives.emplace_back().mode = TINYGLTF_MODE_POINTS;
    }

    tinygltf::Model finish() { return std::move(model_); }

  private:
    /// The mesh of the node of this name. A name may occur again after others: the faces of a group
    /// of an OBJ may stand in several places.
    int mesh_of(const std::string& name) {
        const auto [found, is_new] =
            mesh_of_name_.emplace(name, static_cast<int>(model_.meshes.size()));
        if (is_new) add_node(model_, name, add_mesh(model_, name));
        return found->second;
    }

    std::string title_;  ///< the name of nodes without one
    tinygltf::Model model_;
    std::map<std::string, int> mesh_of_name_;
};

void add_part(void* builder, const SonarsimMeshPart* part) {
    static_cast<ModelBuilder*>(builder)->add(*part);
}

/// libassimp's reader. InputError without it.
SonarsimReadMesh reader_for(const Location& where) {
    try {
        return reinterpret_cast<SonarsimReadMesh>(
            module_symbol(mesh_module, mesh_module_symbol, "libassimp-dev"));
    } catch (const InputError& error) {
        throw InputError(where, std::string("cannot be read: ") + error.what());
    }
}

/// Changes the text of an OBJ where libassimp would misread it: it takes a byte order mark for a
/// part of the first line, and gives the faces before the first usemtl the material of that.
void mend_obj(std::string& text) {
    text = without_byte_order_mark(text);
    // libassimp's name for no material.
    if (text.find("usemtl") != std::string::npos) text.insert(0, "usemtl DefaultMaterial\n");
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 3> formats{"obj", "stl", "ply"};
    if (std::ranges::find(formats, format_of(path)) == formats.end()) return false;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return true;  // read_mesh() says so
    std::array<char, 4> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    return std::string_view(start.data(), start.size()) != "glTF";
}

tinygltf::Model read_mesh(const std::filesystem::path& path) {
    const std::string file = path.string();
    const std::string format = format_of(path);
    std::string bytes = read_file(path, max_mesh_bytes);
    if (format == "obj") mend_obj(bytes);
    std::string_view whole = bytes;
    if (format == "stl") whole = whole_stl(bytes, file);
    if (format == "ply") require_whole_ply(bytes, file);
    const std::string title = in_capitals(format);
    const Location where{file};
    ModelBuilder builder(path);
    std::array<char, 400> error{};
    if (reader_for(where)(format.c_str(), whole.data(), whole.size(), &add_part, &builder,
                          error.data(), error.size()) != 0) {
        throw InputError(where, "is not a valid " + title + "; export it again (libassimp says: " +
                                    printable(error.data()) + ")");
    }
    tinygltf::Model model = builder.finish();
    if (model.meshes.empty()) throw InputError(where, "has no faces; is it an " + title + "?");
    return model;
}

}  // namespace sonarsim
