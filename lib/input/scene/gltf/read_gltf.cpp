#include <array>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "input/scene/gltf/load.h"
#include "input/scene/gltf/nodes.h"

namespace sonarsim {

namespace {

using nlohmann::json;

constexpr std::size_t max_bytes = std::size_t{1} << 31;
constexpr std::uint32_t json_type = 0x4E4F534A;

constexpr std::array<std::string_view, 8> unread_of_file{
    "images", "textures", "samplers", "skins", "animations", "cameras", "extensions", "extras"};
constexpr std::array<std::string_view, 6> unread_of_materials{
    "pbrMetallicRoughness", "normalTexture",  "occlusionTexture",
    "emissiveTexture",      "emissiveFactor", "extensions"};

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

/// Removes a chunk of a .glb from the front of `bytes`.
std::string_view take_chunk(std::string_view& bytes, std::uint32_t type, const Location& where) {
    constexpr std::size_t head = 8;
    if (bytes.size() < head) refuse(where, "the .glb ends within a chunk header");
    const std::size_t length = little_endian(bytes, 0);
    if (little_endian(bytes, 4) != type)
        refuse(where, "the .glb has an unexpected chunk; expected JSON, then BIN");
    if (length > bytes.size() - head)
        refuse(where, "a chunk of the .glb claims {} bytes; the file has {} left", length,
               bytes.size() - head);
    const std::string_view chunk = bytes.substr(head, length);
    bytes.remove_prefix(head + length);
    return chunk;
}

std::string glb_of(std::string header, std::string_view binary) {
    constexpr std::uint32_t magic = 0x46546C67;  // "glTF"
    header.resize((header.size() + 3) / 4 * 4, ' ');
    std::array<std::uint32_t, 5> heads{magic, 2, 0, 0, json_type};
    heads[2] = static_cast<std::uint32_t>(sizeof(heads) + header.size() + binary.size());
    heads[3] = static_cast<std::uint32_t>(header.size());
    std::string bytes(reinterpret_cast<const char*>(heads.data()), sizeof(heads));
    return bytes.append(header).append(binary);
}

/// The JSON without what is not read: tinygltf would load textures, and recurses as deep.
std::string surfaces_of(std::string_view text, const Location& where) {
    constexpr std::size_t max_json_bytes = std::size_t{1} << 28;
    constexpr int max_depth = 64;
    if (text.size() > max_json_bytes)
        refuse(where,
               "holds more than 256 MiB of JSON; put the vertices into a .glb or a .bin file");
    if (is_nested_deeper(text, max_depth)) refuse(where, "the JSON is nested more than 64 deep");
    // Unread parts are not even stored: they may be much larger than the meshes.
    const auto is_read = [](int depth, json::parse_event_t event, const json& parsed) {
        constexpr int file_depth = 1;
        constexpr int material_depth = 3;
        if (event != json::parse_event_t::key) return true;
        const auto& key = parsed.get_ref<const std::string&>();
        return !(depth == file_depth && contains(unread_of_file, key)) &&
               !(depth == material_depth && contains(unread_of_materials, key));
    };
    json document;
    try {
        document = json::parse(text, is_read);
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string fault = error.what();
        throw InputError(where, fault.substr(fault.find("] ") + 2));
    }
    const json::json_pointer place("/asset/version");
    const bool has_version = document.contains(place) && document[place].is_string();
    const std::string version = has_version ? document[place].get<std::string>() : "";
    if (version.empty()) refuse(where, "asset.version is missing; expected glTF version 2.0");
    if (!version.starts_with("2."))
        refuse(where, "is glTF version {}; expected 2.0", printable(version.substr(0, 20)));
    for (const json& mesh : document["meshes"]) {
        // tinygltf takes an object for an array of none.
        if (mesh.is_object() && mesh.contains("primitives") && !mesh["primitives"].is_array())
            refuse(where, "the primitives of a mesh are not an array");
    }
    for (json& buffer : document["buffers"]) {
        if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
        auto& uri = buffer["uri"].get_ref<std::string&>();
        if (uri.starts_with("data:")) continue;
        // tinygltf decodes a plus sign as a blank.
        for (std::size_t at = 0; (at = uri.find('+', at)) != std::string::npos;)
            uri.replace(at, 1, "%2B");
    }
    return document.dump();
}

/// A .glb without unread parts of its JSON. Checks its chunks, as tinygltf 2.7 does not (8 bytes).
std::string reduced_glb(std::string_view bytes, const Location& where) {
    constexpr std::uint32_t binary_type = 0x004E4942;
    constexpr std::size_t head = 12;
    if (bytes.size() < head) refuse(where, "the .glb ends within its header");
    if (little_endian(bytes, 4) != 2)
        refuse(where, "is a .glb of version {}; expected 2", little_endian(bytes, 4));
    const std::size_t length = little_endian(bytes, 8);
    if (length > bytes.size() || length < head)
        refuse(where, "the .glb claims {} bytes; the file has {}", length, bytes.size());
    bytes = bytes.substr(head, length - head);
    const std::string_view text = take_chunk(bytes, json_type, where);
    const std::string_view rest = bytes;
    if (!bytes.empty()) take_chunk(bytes, binary_type, where);
    return glb_of(surfaces_of(text, where), rest.substr(0, rest.size() - bytes.size()));
}

/// InputError for a file that is not even JSON; it names the formats of other meshes.
void require_json(const std::filesystem::path& path, std::string_view bytes) {
    const Location where{path.string()};
    constexpr std::array<std::string_view, 5> others{".fbx", ".dae", ".3ds", ".blend", ".off"};
    if (contains(others, in_lower_case(path.extension().string()))) {
        refuse(where,
               "is not glTF, OBJ, STL or PLY, the formats that are read; convert it: assimp export "
               "{} {}.glb",
               path.filename().string(), path.stem().string());
    }
    const std::string_view text = trim(without_byte_order_mark(bytes));
    if (text.starts_with('{') || text.starts_with('[')) return;
    const std::string format(known_format(bytes));
    const bool is_picture = format.find("picture") != std::string::npos;
    refuse(where, "is {}not glTF; {}", format.empty() ? "" : format + ", ",
           is_picture ? "an image of heights belongs into scene.heightmap"
                      : "a .gltf is JSON, which begins with '{'");
}

void check_extensions(const tinygltf::Model& model, const Location& where) {
    constexpr std::array<std::string_view, 3> compressed{
        "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};
    constexpr std::array<std::string_view, 4> appearance{"KHR_materials_", "KHR_texture_",
                                                         "EXT_texture_", "KHR_lights_"};
    const auto check = [&](const std::string& name, bool is_required) {
        if (contains(compressed, name))
            refuse(where, "is compressed with {}, which is not read; export it uncompressed", name);
        if (name == "EXT_mesh_gpu_instancing")
            refuse(where, "places copies with {}, which is not read; export one node a copy", name);
        const bool is_harmless =
            name == "KHR_mesh_quantization" ||
            std::any_of(appearance.begin(), appearance.end(),
                        [&](std::string_view prefix) { return name.starts_with(prefix); });
        if (is_required && !is_harmless)
            refuse(where, "requires the extension '{}', which is not read", name);
    };
    for (const std::string& name : model.extensionsUsed)
        check(name, false);
    for (const std::string& name : model.extensionsRequired)
        check(name, true);
}

/// Sets the file size callback that tinygltf 2.9 requires; 2.8 has none. read_file limits the size.
void ignore_sizes(auto& callbacks) {
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&,
                                          void*) {
            *size = 0;
            return true;
        };
    }
}

/// True if a URI of a glTF file names a file in its folder or below.
bool stays_below(const std::string& uri) {
    const std::filesystem::path path(uri);
    return uri.find(':') == std::string::npos && uri.find('\0') == std::string::npos &&
           !path.is_absolute() && std::find(path.begin(), path.end(), "..") == path.end();
}

/// The buffers that tinygltf may read: in the file's folder or below, `bytes_left` at most.
struct BufferFiles {
    const std::filesystem::path& gltf;
    std::size_t bytes_left = max_bytes;
};

tinygltf::FsCallbacks buffer_callbacks(BufferFiles& files) {
    tinygltf::FsCallbacks callbacks{};
    ignore_sizes(callbacks);
    callbacks.user_data = &files;
    // Never called, but tinygltf 2.9 requires all callbacks or none.
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.FileExists = [](const std::string& name, void* user) {
        if (stays_below(name)) return !name.empty();
        refuse({static_cast<const BufferFiles*>(user)->gltf.string()},
               "the buffer '{}' is not in the folder of the glTF file or below, where buffers must "
               "lie",
               printable(name.substr(0, 200)));
    };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*,
                                 const std::string& name, void* user) {
        auto& from = *static_cast<BufferFiles*>(user);
        const std::string bytes = read_file(from.gltf.parent_path() / name, from.bytes_left);
        from.bytes_left -= bytes.size();
        out->assign(bytes.begin(), bytes.end());
        return true;
    };
    return callbacks;
}

}  // namespace

tinygltf::Model read_gltf(const std::filesystem::path& path) {
    const Location where{path.string()};
    std::string bytes = read_file(path, max_bytes);
    const bool is_binary = bytes.starts_with("glTF");
    if (!is_binary) require_json(path, bytes);
    bytes = is_binary ? reduced_glb(bytes, where) : surfaces_of(bytes, where);

    tinygltf::TinyGLTF reader;
    BufferFiles files{path};
    reader.SetFsCallbacks(buffer_callbacks(files));
    tinygltf::Model model;
    std::string error;
    std::string warning;
    bool is_read = false;
    try {
        const auto size = static_cast<unsigned int>(bytes.size());
        is_read =
            is_binary
                ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<unsigned char*>(bytes.data()), size)
                : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& fault) {  // a byteLength of 0, or of more than there is
        error = fault.what();
    }
    check_extensions(model, where);
    // tinygltf continues after some errors, and quotes whole data URIs in its messages.
    if (!is_read || !error.empty()) refuse(where, "is not a valid glTF: {}", error.substr(0, 300));
    check_extras(model, where);
    // A CSV trims the names of its materials, too.
    for (tinygltf::Material& material : model.materials)
        material.name = std::string(trim(material.name));
    return model;
}

}  // namespace sonarsim
