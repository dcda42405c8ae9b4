#include "scene/meshes/read_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "core/child_process.h"
#include "core/error.h"
#include "core/file.h"
#include "core/module.h"
#include "core/text.h"
#include "scene/meshes/module.h"
#include "scene/meshes/whole_file.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_mesh_bytes = std::size_t{1} << 31;

/// "stl" for "Hull.STL".
std::string format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension.empty() ? "" : extension.substr(1);
}

/// The child outputs this head for every part, then the part's names, positions and corners. The
/// last head has `is_end`. If the file is faulty, the `node` of the last head is the reason.
struct PartHead {
    std::uint64_t is_end = 0;
    std::uint64_t node_bytes = 0;
    std::uint64_t material_bytes = 0;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t others = 0;
};

constexpr std::size_t vertex_bytes = 3 * sizeof(float);
constexpr std::size_t triangle_bytes = 3 * sizeof(std::uint32_t);

void hand_over(void* output, const SonarsimMeshPart* part) {
    const ChildOutput& write = *static_cast<const ChildOutput*>(output);
    const PartHead head{0,
                        std::strlen(part->node),
                        std::strlen(part->material),
                        part->vertices,
                        part->triangles,
                        part->others};
    write(&head, sizeof(head));
    write(part->node, head.node_bytes);
    write(part->material, head.material_bytes);
    write(part->positions, head.vertices * vertex_bytes);
    write(part->corners, head.triangles * triangle_bytes);
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

/// All parts of the file, as the child hands them over.
std::string parts_of(const std::string& format, std::string_view bytes, const Location& where) {
    const SonarsimReadMesh read = reader_for(where);
    // Many times the time that an intact file needs on a slow machine.
    const unsigned long cpu_s = 30 + static_cast<unsigned long>(bytes.size() / 100'000);
    const ChildLimits limits{(std::size_t{1} << 29) + 64 * bytes.size(), cpu_s,
                             5.0 * static_cast<double>(cpu_s)};
    const auto work = [&](const ChildOutput& output) {
        std::array<char, 400> error{};
        ChildOutput write = output;
        const bool failed = read(format.c_str(), bytes.data(), bytes.size(), &hand_over, &write,
                                 error.data(), error.size()) != 0;
        const PartHead end{1, failed ? std::strlen(error.data()) : 0, 0, 0, 0, 0};
        output(&end, sizeof(end));
        output(error.data(), end.node_bytes);
    };
    try {
        return bytes_of_child(work, limits);
    } catch (const InputError& error) {
        throw InputError(where, std::string("is damaged or too large: libassimp ") + error.what() +
                                    " as it read the file; export it again");
    }
}

/// Makes a model of what the child handed over.
class ModelBuilder {
  public:
    explicit ModelBuilder(const std::filesystem::path& path) : path_(path) {
        model_.buffers.emplace_back();
    }

    void add(const PartHead& head, std::string_view& bytes) {
        // Files may have names in any encoding; those of a dataset are UTF-8.
        std::string name = printable(take(bytes, head.node_bytes));
        if (name.empty()) name = printable(path_.stem().string());
        const std::string material = printable(take(bytes, head.material_bytes));
        auto& primitives = mesh_of(name).primitives;
        const int positions = add_accessor(take(bytes, head.vertices * vertex_bytes), head.vertices,
                                           TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
        if (head.triangles > 0) {
            tinygltf::Primitive& primitive = primitives.emplace_back();
            primitive.mode = TINYGLTF_MODE_TRIANGLES;
            primitive.attributes["POSITION"] = positions;
            primitive.indices =
                add_accessor(take(bytes, head.triangles * triangle_bytes), 3 * head.triangles,
                             TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
            primitive.material = material.empty() ? -1 : number_of(material);
        }
        if (head.others > 0) primitives.emplace_back().mode = TINYGLTF_MODE_POINTS;
    }

    tinygltf::Model finish() { return std::move(model_); }

    std::string_view take(std::string_view& bytes, std::size_t count) const {
        if (count > bytes.size()) {
            throw InputError(Location{path_.string()},
                             "is damaged: libassimp could not make sense of it; export it again");
        }
        const std::string_view taken = bytes.substr(0, count);
        bytes.remove_prefix(count);
        return taken;
    }

  private:
    /// The mesh of the node of this name. A name may occur again after others: the faces of a group
    /// of an OBJ may stand in several places.
    tinygltf::Mesh& mesh_of(const std::string& name) {
        const auto [found, is_new] = mesh_of_name_.emplace(name, model_.meshes.size());
        if (is_new) {
            tinygltf::Node& node = model_.nodes.emplace_back();
            node.name = name;
            node.mesh = static_cast<int>(model_.meshes.size());
            model_.meshes.emplace_back().name = name;
        }
        return model_.meshes[found->second];
    }

    int add_accessor(std::string_view bytes, std::size_t count, int component, int type) {
        auto& data = model_.buffers.front().data;
        tinygltf::BufferView& view = model_.bufferViews.emplace_back();
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = bytes.size();
        data.insert(data.end(), bytes.begin(), bytes.end());
        tinygltf::Accessor& accessor = model_.accessors.emplace_back();
        accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
        accessor.componentType = component;
        accessor.count = count;
        accessor.type = type;
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    int number_of(const std::string& material) {
        auto& known = model_.materials;
        const auto found = std::ranges::find(known, material, &tinygltf::Material::name);
        if (found == known.end()) {
            known.emplace_back().name = material;
            return static_cast<int>(known.size()) - 1;
        }
        return static_cast<int>(found - known.begin());
    }

    const std::filesystem::path& path_;
    tinygltf::Model model_;
    std::map<std::string, std::size_t> mesh_of_name_;
};

tinygltf::Model model_of(std::string_view bytes, const std::filesystem::path& path,
                         const std::string& title) {
    ModelBuilder builder(path);
    for (bool is_empty = true;; is_empty = false) {
        PartHead head;
        std::memcpy(&head, builder.take(bytes, sizeof(head)).data(), sizeof(head));
        if (head.is_end == 0) {
            builder.add(head, bytes);
            continue;
        }
        if (head.node_bytes > 0) {
            throw InputError(Location{path.string()},
                             "is no valid " + title + "; export it again (libassimp says: " +
                                 printable(builder.take(bytes, head.node_bytes)) + ")");
        }
        if (!is_empty) return builder.finish();
        throw InputError(Location{path.string()}, "has no faces; is it an " + title + "?");
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
    std::string title = format;
    for (char& c : title)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return model_of(parts_of(format, whole, Location{file}), path, title);
}

}  // namespace sonarsim
