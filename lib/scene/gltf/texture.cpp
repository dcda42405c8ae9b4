#include "scene/gltf/texture.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf/file.h"

namespace sonarsim {

namespace {

using nlohmann::json;

/// An element of an array of the document.
const json& element(const json& document, const char* array, int index, const Location& where) {
    const auto found = document.find(array);
    if (found == document.end() || static_cast<std::size_t>(index) >= found->size())
        throw InputError(where,
                         std::string(array) + "[" + std::to_string(index) + "] does not exist");
    return (*found)[static_cast<std::size_t>(index)];
}

/// The images that materials name as baseColorTexture.
std::set<int> images_of_materials(const json& document, const Location& where) {
    std::set<int> images;
    for (const json& material : document.value("materials", json::array())) {
        const json colours = material.value("pbrMetallicRoughness", json::object());
        const auto use = colours.find("baseColorTexture");
        if (use == colours.end()) continue;
        if (use->contains("extensions") && !use->at("extensions").empty())
            throw InputError(where,
                             "moves its texture with KHR_texture_transform, which is not read; "
                             "apply it to the texture coordinates in the mesh's editor");
        if (use->value("texCoord", 0) != 0)
            throw InputError(where,
                             "lays its texture by another TEXCOORD than TEXCOORD_0, the one that "
                             "is read; make it the first in the mesh's editor");
        const json& texture = element(document, "textures", use->value("index", 0), where);
        if (!texture.contains("source"))
            throw InputError(where,
                             "has a texture without a PNG; export its textures as PNG, or name "
                             "the image itself");
        images.insert(texture.at("source").get<int>());
    }
    return images;
}

/// The bytes of a part of the file's buffers.
std::string_view bytes_of_view(const tinygltf::Model& model, int index, const Location& where) {
    const auto at = static_cast<std::size_t>(index);
    if (at < model.bufferViews.size()) {
        const tinygltf::BufferView& view = model.bufferViews[at];
        const auto buffer = static_cast<std::size_t>(view.buffer);
        if (view.buffer >= 0 && buffer < model.buffers.size()) {
            const std::vector<unsigned char>& data = model.buffers[buffer].data;
            if (view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset)
                return std::string_view(reinterpret_cast<const char*>(data.data()), data.size())
                    .substr(view.byteOffset, view.byteLength);
        }
    }
    throw InputError(where, "its image reaches beyond bufferViews[" + std::to_string(index) + "]");
}

Image read_data_uri(const std::string& uri, const Location& where) {
    std::vector<unsigned char> bytes;
    std::string type;
    if (!tinygltf::DecodeDataURI(&bytes, type, uri, 0, false))
        throw InputError(where, "has a data URI of an image that cannot be decoded");
    return read_image({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, where);
}

/// A URI has other letters as %20.
std::string decoded(const std::string& uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::string digits = uri.substr(i + 1, 2);
        const bool is_code =
            uri[i] == '%' && digits.size() == 2 &&
            digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
        out += is_code ? static_cast<char>(std::stoi(digits, nullptr, 16)) : uri[i];
        if (is_code) i += 2;
    }
    return out;
}

}  // namespace

Image read_texture(const std::filesystem::path& gltf) {
    const Location where{gltf.string()};
    const json document = json::parse(read_texture_json(gltf));
    const std::set<int> images = images_of_materials(document, where);
    if (images.size() != 1) {
        throw InputError(where,
                         (images.empty() ? "has no material with a baseColorTexture"
                                         : "has materials with " + std::to_string(images.size()) +
                                               " images, and a map has one") +
                             "; name an image as the map's file");
    }
    const json& image = element(document, "images", *images.begin(), where);
    if (image.contains("bufferView")) {
        const tinygltf::Model model = read_gltf(gltf);
        return read_image(bytes_of_view(model, image.at("bufferView").get<int>(), where), where);
    }
    const std::string uri = image.value("uri", "");
    if (uri.starts_with("data:")) return read_data_uri(uri, where);
    const std::string name = decoded(uri);
    if (name.empty() || !stays_below(name)) {
        throw InputError(where,
                         "the image '" + printable(name.substr(0, 200)) +
                             "' is not in the folder of the glTF file or below, where images must "
                             "lie");
    }
    return read_image(gltf.parent_path() / name);
}

}  // namespace sonarsim
