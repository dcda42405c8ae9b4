#include "scene/gltf/file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/known_format.h"
#include "core/text.h"
#include "scene/gltf/reduced_json.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 31;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

/// Removes a chunk of a .glb from the front of `bytes`.
std::string_view take_chunk(std::string_view& bytes, std::uint32_t type, const Location& where) {
    constexpr std::size_t head = 8;
    if (bytes.size() < head) throw InputError(where, "the .glb ends within a chunk header");
    const std::size_t length = little_endian(bytes, 0);
    if (little_endian(bytes, 4) != type) {
        throw InputError(where, "the .glb has an unexpected chunk; expected JSON, then BIN");
    }
    if (length > bytes.size() - head) {
        throw InputError(where, "a chunk of the .glb claims " + std::to_string(length) +
                                    " bytes; the file has " + std::to_string(bytes.size() - head) +
                                    " left");
    }
    const std::string_view chunk = bytes.substr(head, length);
    bytes.remove_prefix(head + length);
    return chunk;
}

/// The JSON of a .glb. Checks that its chunks lie within it, which tinygltf 2.7 does not do for the
/// last 8 bytes.
std::string_view json_chunk(std::string_view bytes, const Location& where) {
    constexpr std::uint32_t json_type = 0x4E4F534A;
    constexpr std::uint32_t binary_type = 0x004E4942;
    constexpr std::size_t head = 12;
    if (bytes.size() < head) throw InputError(where, "the .glb ends within its header");
    if (little_endian(bytes, 4) != 2) {
        throw InputError(where, "is a .glb of version " + std::to_string(little_endian(bytes, 4)) +
                                    "; expected 2");
    }
    const std::size_t length = little_endian(bytes, 8);
    if (length > bytes.size() || length < head) {
        throw InputError(where, "the .glb claims " + std::to_string(length) +
                                    " bytes; the file has " + std::to_string(bytes.size()));
    }
    bytes = bytes.substr(head, length - head);
    const std::string_view json = take_chunk(bytes, json_type, where);
    if (!bytes.empty()) take_chunk(bytes, binary_type, where);
    return json;
}

void put_little_endian(std::string& bytes, std::size_t at, std::size_t number) {
    const auto value = static_cast<std::uint32_t>(number);
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

/// Reduces the JSON of a .glb to the part that is read.
void reduce_json_chunk(std::string& bytes, const Location& where) {
    constexpr std::size_t json_at = 20;  // behind the header of the file and that of the chunk
    const std::string_view json = json_chunk(bytes, where);
    std::string reduced = reduced_gltf_json(json, where.file);
    reduced.resize((reduced.size() + 3) / 4 * 4, ' ');
    put_little_endian(bytes, 8, little_endian(bytes, 8) - json.size() + reduced.size());
    put_little_endian(bytes, 12, reduced.size());
    bytes.replace(json_at, json.size(), reduced);
}

bool contains(std::span<const std::string_view> list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

/// Names other mesh formats in the message, since the parser would only call them malformed.
void check_format(const std::filesystem::path& path, std::string_view bytes) {
    constexpr std::array<std::string_view, 5> others{".fbx", ".dae", ".3ds", ".blend", ".off"};
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!contains(others, extension) || bytes.starts_with("glTF")) return;
    std::filesystem::path converted = path;
    converted.replace_extension(".glb");
    throw InputError(Location{path.string()},
                     "is no glTF, OBJ, STL or PLY, the formats that are read; convert it: assimp "
                     "export " +
                         path.filename().string() + " " + converted.filename().string());
}

/// Throws InputError for a file that is not even JSON.
void check_json(std::string_view bytes, const Location& where) {
    const std::string_view text = trim(without_byte_order_mark(bytes));
    if (text.starts_with('{') || text.starts_with('[')) return;
    const std::string format(known_format(bytes));
    const bool is_picture = format.find("picture") != std::string::npos;
    throw InputError(where, "is " + (format.empty() ? "" : format + ", ") + "no glTF; " +
                                (is_picture ? "an image of heights belongs into scene.heightmap"
                                            : "a .gltf is JSON, which begins with '{'"));
}

void check_extensions(const tinygltf::Model& model, const Location& where) {
    constexpr std::array<std::string_view, 3> compressed{
        "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};
    constexpr std::array<std::string_view, 4> appearance{"KHR_materials_", "KHR_texture_",
                                                         "EXT_texture_", "KHR_lights_"};
    const auto check = [&](const std::string& name, bool is_required) {
        if (contains(compressed, name)) {
            throw InputError(where, "is compressed with " + name +
                                        ", which is not read; export it uncompressed");
        }
        if (name == "EXT_mesh_gpu_instancing") {
            throw InputError(where, "places copies with " + name +
                                        ", which is not read; export one node a copy");
        }
        const bool is_harmless =
            name == "KHR_mesh_quantization" ||
            std::any_of(appearance.begin(), appearance.end(),
                        [&](std::string_view prefix) { return name.starts_with(prefix); });
        if (is_required && !is_harmless)
            throw InputError(where, "requires the extension '" + name + "', which is not read");
    };
    for (const std::string& name : model.extensionsUsed)
        check(name, false);
    for (const std::string& name : model.extensionsRequired)
        check(name, true);
}

/// Sets the file size callback that tinygltf 2.9 requires; 2.8 has none. read_file limits the size.
template <class Callbacks>
void ignore_sizes(Callbacks& callbacks) {
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&,
                                          void*) {
            *size = 0;
            return true;
        };
    }
}

/// The buffers that tinygltf may read: in the folder of the glTF file or below, `bytes_left` at
/// most.
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
        throw InputError(
            Location{static_cast<const BufferFiles*>(user)->gltf.string()},
            "the buffer '" + printable(name.substr(0, 200)) +
                "' is not in the folder of the glTF file or below, where buffers must lie");
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

bool stays_below(const std::string& uri) {
    const std::filesystem::path path(uri);
    return uri.find(':') == std::string::npos && uri.find('\0') == std::string::npos &&
           !path.is_absolute() && std::find(path.begin(), path.end(), "..") == path.end();
}

tinygltf::Model read_gltf(const std::filesystem::path& path) {
    const Location where{path.string()};
    std::string bytes = read_file(path, max_bytes);
    check_format(path, bytes);
    const bool is_binary = bytes.starts_with("glTF");
    if (is_binary) {
        reduce_json_chunk(bytes, where);
    } else {
        check_json(bytes, where);
        bytes = reduced_gltf_json(bytes, where.file);
    }

    tinygltf::TinyGLTF reader;
    BufferFiles files{path};
    reader.SetFsCallbacks(buffer_callbacks(files));
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool is_read =
        is_binary
            ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<unsigned char*>(bytes.data()), size)
            : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    check_extensions(model, where);
    // tinygltf continues after some errors, and quotes whole data URIs in its messages.
    if (!is_read || !error.empty())
        throw InputError(where, "is no valid glTF: " + error.substr(0, 300));
    for (std::size_t i = 1; i < model.buffers.size(); ++i) {
        if (!model.buffers[i].uri.empty()) continue;
        throw InputError(where, "buffers[" + std::to_string(i) +
                                    "]: has no uri, and only the first buffer of a .glb with a BIN "
                                    "chunk may lack it");
    }
    return model;
}

}  // namespace sonarsim
