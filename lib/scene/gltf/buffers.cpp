#include "scene/gltf/buffers.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/error.h"

namespace sonarsim {

namespace {

using nlohmann::json;

int hex_digit(char c) {
    constexpr std::string_view digits = "0123456789abcdef";
    const char lower = c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto at = digits.find(lower);
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

std::string percent_decode(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                             hex_digit(uri[i + 2]) >= 0;
        out += is_code ? static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]))
                       : uri[i];
        if (is_code) i += 2;
    }
    return out;
}

bool stays_below(const std::string& uri) {
    const std::filesystem::path path(uri);
    return !uri.empty() && uri.find(':') == std::string::npos &&
           uri.find('\0') == std::string::npos && !path.is_absolute() &&
           std::find(path.begin(), path.end(), "..") == path.end();
}

/// Notes the source of buffer `index` and renames its URI.
GltfBuffer claim_buffer(json& entry, std::size_t index, bool has_binary_chunk,
                        const std::string& file) {
    constexpr std::array<std::string_view, 2> embedded{"data:application/octet-stream;base64,",
                                                       "data:application/gltf-buffer;base64,"};
    const std::string where = "buffers[" + std::to_string(index) + "]";
    GltfBuffer result;
    if (!entry.contains("byteLength")) {
        throw InputError(Location{file}, where + ": byteLength is missing");
    }
    result.byte_length = entry["byteLength"].get<std::size_t>();
    if (!entry.contains("uri")) {
        if (index != 0 || !has_binary_chunk) {
            throw InputError(Location{file}, where +
                                                 ": has no uri, and only the first buffer of a "
                                                 ".glb with a BIN chunk may lack it");
        }
        result.source = GltfBuffer::Source::binary_chunk;
    } else {
        const std::string& uri = entry["uri"].get_ref<const std::string&>();
        if (uri.starts_with(embedded[0]) || uri.starts_with(embedded[1])) return result;
        if (uri.starts_with("data:")) {
            throw InputError(Location{file}, where + ": its data URI must start with '" +
                                                 std::string(embedded[0]) + "'");
        }
        result.source = GltfBuffer::Source::file;
        result.file = percent_decode(uri);
        if (!stays_below(result.file)) {
            throw InputError(Location{file},
                             where + ": '" + uri.substr(0, 200) +
                                 "' is not beside or below the glTF file, where buffers must lie");
        }
    }
    entry["uri"] = std::to_string(index);
    return result;
}

}  // namespace

std::vector<GltfBuffer> claim_buffers(json& gltf, bool has_binary_chunk, const std::string& file) {
    std::vector<GltfBuffer> buffers;
    if (!gltf.contains("buffers")) return buffers;
    for (json& entry : gltf["buffers"]) {
        buffers.push_back(claim_buffer(entry, buffers.size(), has_binary_chunk, file));
    }
    return buffers;
}

}  // namespace sonarsim
