#include "input/scene/meshes/read_mesh.h"

#include <array>
#include <fstream>
#include <map>
#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "core/module.h"
#include "core/text.h"
#include "input/scene/meshes/mesh_text.h"
#include "input/scene/meshes/module.h"
#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_mesh_bytes = std::size_t{1} << 31;

/// "stl" for "Hull.STL".
std::string format_of(const std::filesystem::path& path) {
    const std::string extension = in_lower_case(path.extension().string());
    return extension.empty() ? "" : extension.substr(1);
}

constexpr const char* cut_off = "; it was cut off: copy or export it again";

/// A type of numbers in a PLY.
struct PlyType {
    std::size_t bytes = 0;
    bool is_signed = false;
};

struct PlyProperty {
    std::optional<PlyType> count;  ///< none: the property is not a list
    PlyType value;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties = {};
};

struct PlyHeader {
    bool is_text = true;
    bool is_big_endian = false;
    std::vector<PlyElement> elements = {};
};

std::optional<PlyType> type_of(std::string_view name) {
    static const std::map<std::string_view, PlyType> types{
        {"char", {1, true}},   {"uchar", {1, false}},  {"int8", {1, true}},
        {"uint8", {1, false}}, {"short", {2, true}},   {"ushort", {2, false}},
        {"int16", {2, true}},  {"uint16", {2, false}}, {"int", {4, true}},
        {"uint", {4, false}},  {"int32", {4, true}},   {"uint32", {4, false}},
        {"float", {4, true}},  {"float32", {4, true}}, {"double", {8, true}},
        {"float64", {8, true}}};
    const auto found = types.find(name);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

/// Reads a line of the file's header into `header`. False if the line is faulty.
bool read_line(std::string_view line, PlyHeader& header) {
    const std::string_view key = take_word(line);
    if (key == "comment" || key == "obj_info" || key == "ply") return true;
    const std::string_view word = take_word(line);
    if (key == "format") {
        header.is_text = word == "ascii";
        header.is_big_endian = word == "binary_big_endian";
        return header.is_text || header.is_big_endian || word == "binary_little_endian";
    }
    if (key == "element") {
        const auto count = parse_unsigned(take_word(line));
        if (count) header.elements.push_back({std::string(word), *count});
        return count.has_value();
    }
    if (key != "property" || header.elements.empty()) return false;
    const bool is_list = word == "list";
    const std::optional<PlyType> count = is_list ? type_of(take_word(line)) : std::nullopt;
    const std::optional<PlyType> value = type_of(is_list ? take_word(line) : word);
    if (value) header.elements.back().properties.push_back({count, *value});
    return value && count.has_value() == is_list;
}

/// Takes the header from the front of `bytes`.
PlyHeader take_header(std::string_view& bytes, const Location& file) {
    PlyHeader header;
    for (int number = 1;; ++number) {
        const Location where{file.file, number};
        if (bytes.empty()) refuse(where, "the header of the PLY has no end_header{}", cut_off);
        const std::string_view line = take_line(bytes);
        if (number == 1 && line != "ply")
            refuse(where, "is not a PLY: its first line is not 'ply'");
        if (line == "end_header") break;
        if (read_line(line, header)) continue;
        refuse(where, "'{}' is not a line of a PLY's header", printable(line.substr(0, 100)));
    }
    for (const PlyElement& element : header.elements) {
        if (element.properties.empty())
            refuse(file, "element '{}' of the PLY has no property", printable(element.name));
    }
    return header;
}

/// Takes `count` values from the front of `body`. False at its end.
bool take_values(std::string_view& body, const PlyHeader& header, const PlyType& type,
                 std::uint64_t count) {
    if (!header.is_text) {
        if (count > body.size() / type.bytes) return false;
        body.remove_prefix(count * type.bytes);
        return true;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        if (take_word(body).empty()) return false;
    }
    return true;
}

/// The count of a list; nothing at the end of the file and for a negative count.
std::optional<std::uint64_t> take_count(std::string_view& body, const PlyHeader& header,
                                        const PlyType& type) {
    if (header.is_text) return parse_unsigned(take_word(body));
    if (type.bytes > 4 || body.size() < type.bytes) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
        const std::size_t at = header.is_big_endian ? i : type.bytes - 1 - i;
        value = value << 8U | static_cast<unsigned char>(body[at]);
    }
    body.remove_prefix(type.bytes);
    const bool is_negative = type.is_signed && (value >> (8 * type.bytes - 1)) != 0;
    return is_negative ? std::nullopt : std::optional(value);
}

bool take_element(std::string_view& body, const PlyHeader& header, const PlyElement& element) {
    return std::ranges::all_of(element.properties, [&](const PlyProperty& property) {
        const std::optional<std::uint64_t> count =
            property.count ? take_count(body, header, *property.count) : 1;
        return count && take_values(body, header, property.value, *count);
    });
}

/// The relevant part of an STL: a binary one without the bytes that exporters leave behind its
/// triangles. InputError if it holds fewer or more triangles than it claims.
std::string_view whole_stl(std::string& text, const Location& where) {
    const std::string_view bytes = text;
    constexpr std::size_t head = 84;
    constexpr std::size_t triangle_bytes = 50;
    std::uint32_t claimed = 0;
    if (bytes.size() >= head) std::memcpy(&claimed, bytes.data() + head - 4, sizeof(claimed));
    const std::size_t size = head + triangle_bytes * claimed;
    // Binary files may begin with "solid", too: then the claimed size decides.
    std::string_view rest = bytes;
    const bool may_be_text =
        take_word(rest) == "solid" && bytes.substr(0, head).find('\0') == std::string_view::npos;
    if (may_be_text && size != bytes.size()) {
        if (bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 4096))
                .rfind("endsolid") == std::string_view::npos)
            refuse(where, "the STL has no endsolid{}", cut_off);
        return text = mended_text(text, where);
    }
    if (bytes.size() < head) refuse(where, "is not an STL: it is too short for one");
    if (size > bytes.size() || bytes.size() - size >= triangle_bytes) {
        refuse(
            where,
            "is not a binary STL, or not whole: it claims {} triangles, which take {} bytes, and "
            "has {}; copy or export it again",
            claimed, size, bytes.size());
    }
    return bytes.substr(0, size);
}

/// InputError for a PLY with a faulty header, or cut off: libassimp reads past its end.
void require_whole_ply(std::string_view bytes, const Location& where) {
    const PlyHeader header = take_header(bytes, where);
    for (const PlyElement& element : header.elements) {
        // libassimp reads only the first triangle of a strip.
        if (element.name == "tristrips" && element.count > 0) {
            refuse(where,
                   "has its surface as strips of triangles (tristrips), which are not read; save "
                   "it with faces, as MeshLab does");
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (take_element(bytes, header, element)) continue;
            refuse(where,
                   "element '{}' of the PLY ends or is faulty in number {} of {}; copy or export "
                   "the file again",
                   printable(element.name), i + 1, element.count);
        }
    }
}

/// Makes a model of the parts of a file.
struct ModelBuilder {
    std::string title;  ///< the name of nodes without one
    tinygltf::Model model = {};
    std::map<std::string, int> mesh_of_name = {};

    void add(const SonarsimMeshPart& part) {
        // Files may have names in any encoding; those of a dataset are UTF-8.
        std::string node = part.node;
        std::ranges::replace(node, blank_of_name, ' ');
        const std::string name = printable(node);
        const int mesh = mesh_of(name.empty() ? title : name);
        if (part.triangles > 0) {
            const int positions =
                add_positions(model, {part.positions, part.positions + 3 * part.vertices});
            add_triangles(model, mesh, positions, {part.corners, part.corners + 3 * part.triangles},
                          material_number(model, printable(part.material)));
        }
        if (part.others == 0) return;
        auto& primitives = model.meshes[static_cast<std::size_t>(mesh)].primitives;
        primitives.emplace_back().mode = TINYGLTF_MODE_POINTS;
    }

    /// The mesh of the node of this name. Faces of a group of an OBJ may stand in several places.
    int mesh_of(const std::string& name) {
        const auto [found, is_new] =
            mesh_of_name.emplace(name, static_cast<int>(model.meshes.size()));
        if (is_new) add_node(model, name, add_mesh(model, name));
        return found->second;
    }
};

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 3> formats{"obj", "stl", "ply"};
    if (!contains(formats, format_of(path))) return false;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return true;  // read_mesh() says so
    std::array<char, 4> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    return std::string_view(start.data(), start.size()) != "glTF";
}

tinygltf::Model read_mesh(const std::filesystem::path& path) {
    const Location where{path.string()};
    const std::string format = format_of(path);
    std::string bytes = read_file(path, max_mesh_bytes);
    if (format == "obj") bytes = mended_text(without_byte_order_mark(bytes), where);
    // libassimp gives faces before the first usemtl its material. This is its name for none.
    if (format == "obj" && bytes.find("usemtl") != std::string::npos)
        bytes.insert(0, "usemtl DefaultMaterial\n");
    std::string_view whole = bytes;
    if (format == "stl") whole = whole_stl(bytes, where);
    if (format == "ply") require_whole_ply(bytes, where);
    const std::string title = in_capitals(format);
    ModelBuilder builder{.title = printable(path.stem().string())};
    const SonarsimAddPart add = [](void* user, const SonarsimMeshPart* part) {
        static_cast<ModelBuilder*>(user)->add(*part);
    };
    std::array<char, 400> error{};
    const auto read = reinterpret_cast<SonarsimReadMesh>(
        module_symbol(mesh_module, mesh_module_symbol, "libassimp-dev", where));
    if (read(format.c_str(), whole.data(), whole.size(), add, &builder, error.data(),
             error.size()) != 0) {
        refuse(where, "is not a valid {}; export it again (libassimp says: {})", title,
               printable(error.data()));
    }
    if (builder.model.meshes.empty()) refuse(where, "has no faces; is it an {}?", title);
    return std::move(builder.model);
}

}  // namespace sonarsim
