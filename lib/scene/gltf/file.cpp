#include "scene/gltf/file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "scene/gltf/buffers.h"
#include "scene/gltf/json.h"

namespace sonarsim {

namespace {

using nlohmann::json;

constexpr std::size_t max_bytes = std::size_t{1} << 31;

struct Container {
    std::string_view json;
    std::string_view binary;  // the BIN chunk of a .glb
    bool has_binary = false;
};

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

Container open_container(std::string_view bytes, const Location& where) {
    constexpr std::uint32_t json_type = 0x4E4F534A;
    constexpr std::uint32_t binary_type = 0x004E4942;
    constexpr std::size_t head = 12;
    if (!bytes.starts_with("glTF")) return {bytes, {}, false};
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
    Container container;
    container.json = take_chunk(bytes, json_type, where);
    // Later chunks belong to extensions; a reader has to skip them.
    container.has_binary = bytes.size() >= 8 && little_endian(bytes, 4) == binary_type;
    if (container.has_binary) container.binary = take_chunk(bytes, binary_type, where);
    return container;
}

bool contains(std::span<const std::string_view> list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

/// Names other mesh formats in the message, since the parser would only call them malformed.
void check_format(const std::filesystem::path& path, std::string_view bytes) {
    constexpr std::array<std::string_view, 5> others{".obj", ".stl", ".fbx", ".dae", ".ply"};
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!contains(others, extension) || bytes.starts_with("glTF")) return;
    std::filesystem::path converted = path;
    converted.replace_extension(".glb");
    throw InputError(Location{path.string()},
                     "is no glTF, the only format that is read; convert it: assimp export " +
                         path.filename().string() + " " + converted.filename().string());
}

void check_extensions(const json& document, const std::string& file) {
    constexpr std::array<std::string_view, 3> compressed{
        "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};
    constexpr std::array<std::string_view, 4> appearance{"KHR_materials_", "KHR_texture_",
                                                         "EXT_texture_", "KHR_lights_"};
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        for (const json& entry : document.value(list, json::array())) {
            const std::string name = entry.get<std::string>();
            if (contains(compressed, name)) {
                throw InputError(Location{file}, "is compressed with " + name +
                                                     ", which is not read; export it uncompressed");
            }
            if (name == "EXT_mesh_gpu_instancing") {
                throw InputError(Location{file}, "places copies with " + name +
                                                     ", which is not read; export one node a copy");
            }
            const bool is_harmless =
                name == "KHR_mesh_quantization" ||
                std::any_of(appearance.begin(), appearance.end(),
                            [&](std::string_view prefix) { return name.starts_with(prefix); });
            if (std::string_view(list) == "extensionsRequired" && !is_harmless) {
                throw InputError(Location{file},
                                 "requires the extension '" + name + "', which is not read");
            }
        }
    }
}

/// The buffers that tinygltf's file callbacks may read, by index.
struct BufferReader {
    const std::filesystem::path& gltf;
    std::string_view binary;
    const std::vector<GltfBuffer>& buffers;
    std::size_t bytes_left = max_bytes;

    std::vector<unsigned char> read(std::size_t index) {
        const GltfBuffer& buffer = buffers.at(index);
        if (buffer.source == GltfBuffer::Source::file) {
            const std::string bytes = read_file(gltf.parent_path() / buffer.file, bytes_left);
            bytes_left -= bytes.size();
            return {bytes.begin(), bytes.end()};
        }
        if (buffer.byte_length > binary.size()) {
            throw InputError(Location{gltf.string()},
                             "buffers[0] claims " + std::to_string(buffer.byte_length) +
                                 " bytes; the BIN chunk has " + std::to_string(binary.size()));
        }
        const auto bytes = binary.substr(0, buffer.byte_length);
        return {bytes.begin(), bytes.end()};
    }
};

/// Sets the file size callback that tinygltf 2.9 requires; 2.8 has none.
template <class Callbacks>
void tell_sizes(Callbacks& callbacks) {
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& name,
                                          void* user) {
            const auto* buffers = static_cast<const BufferReader*>(user);
            *size = buffers->buffers.at(std::stoul(name)).byte_length;
            return true;
        };
    }
}

tinygltf::FsCallbacks callbacks_of(BufferReader& buffers) {
    tinygltf::FsCallbacks callbacks{};
    tell_sizes(callbacks);
    // Never called, but tinygltf 2.9 requires all callbacks or none.
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    callbacks.FileExists = [](const std::string&, void*) { return true; };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*,
                                 const std::string& name, void* user) {
        *out = static_cast<BufferReader*>(user)->read(std::stoul(name));
        return true;
    };
    callbacks.user_data = &buffers;
    return callbacks;
}

}  // namespace

tinygltf::Model read_gltf(const std::filesystem::path& path) {
    const std::string file = path.string();
    const std::string bytes = read_file(path, max_bytes);
    check_format(path, bytes);
    const Container container = open_container(bytes, Location{file});
    json gltf = reduce_gltf_json(container.json, file);
    check_extensions(gltf, file);
    const std::vector<GltfBuffer> buffers = claim_buffers(gltf, container.has_binary, file);
    const std::string text = gltf.dump();

    BufferReader buffer_reader{path, container.binary, buffers};
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks(callbacks_of(buffer_reader));
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool is_read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                    static_cast<unsigned int>(text.size()), "");
    // tinygltf continues after some errors, and quotes whole data URIs in its messages.
    if (!is_read || !error.empty()) {
        throw InputError(Location{file}, "is no valid glTF: " + error.substr(0, 300));
    }
    return model;
}

}  // namespace sonarsim
