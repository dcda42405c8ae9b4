#include "scene/gltf/texture.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf/file.h"
#include "scene/images/side_by_side.h"

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

/// The image that a material names as baseColorTexture; -1: none.
int image_of_material(const json& document, const json& material, const Location& where) {
    const json colours = material.value("pbrMetallicRoughness", json::object());
    const auto use = colours.find("baseColorTexture");
    if (use == colours.end()) return -1;
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
    const int image = texture.at("source").get<int>();
    element(document, "images", image, where);
    return image;
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

/// Decodes a URI: "%20" becomes a blank, and other codes likewise.
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

/// Reads images of a glTF file.
class TextureReader {
  public:
    TextureReader(const std::filesystem::path& gltf, const json& document, ImageReader& images)
        : gltf_(gltf), where_{gltf.string()}, document_(document), images_(images) {}

    Image read(int index) {
        const json& image = element(document_, "images", index, where_);
        if (image.contains("bufferView")) {
            if (!model_) model_ = read_gltf(gltf_);
            const int view = image.at("bufferView").get<int>();
            return images_.read(bytes_of_view(*model_, view, where_), where_);
        }
        const std::string uri = image.value("uri", "");
        if (uri.starts_with("data:")) return read_data_uri(uri);
        const std::string name = decoded(uri);
        if (name.empty() || !stays_below(name)) {
            throw InputError(where_,
                             "the image '" + printable(name.substr(0, 200)) +
                                 "' is not in the folder of the glTF file or below, where images "
                                 "must lie");
        }
        return images_.read(gltf_.parent_path() / name);
    }

  private:
    Image read_data_uri(const std::string& uri) {
        std::vector<unsigned char> bytes;
        std::string type;
        if (!tinygltf::DecodeDataURI(&bytes, type, uri, 0, false))
            throw InputError(where_, "has a data URI of an image that cannot be decoded");
        return images_.read({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, where_);
    }

    const std::filesystem::path& gltf_;
    Location where_;
    const json& document_;
    ImageReader& images_;
    std::optional<tinygltf::Model> model_;
};

/// The images `used`, side by side. `of_material` holds the image of each material, or -1.
Texture laid_side_by_side(TextureReader& reader, const std::vector<int>& used,
                          const std::vector<int>& of_material, const Location& where) {
    std::vector<Image> images;
    std::size_t values = 0;
    for (const int image : used) {
        values += images.emplace_back(reader.read(image)).values.size();
        if (values > most_image_values)
            throw InputError(where, "has images of more than 2^26 values; make them smaller");
    }
    SideBySide all = side_by_side(images, where);
    Texture out{std::move(all.image), {}};
    for (const int image : of_material) {
        const auto place = std::ranges::find(used, image) - used.begin();
        std::optional<Eigen::AlignedBox2d>& part = out.part_of_material.emplace_back();
        if (image >= 0) part = all.places[static_cast<std::size_t>(place)];
    }
    return out;
}

}  // namespace

Texture read_texture(const std::filesystem::path& gltf, ImageReader& images) {
    const Location where{gltf.string()};
    const json document = json::parse(read_texture_json(gltf));
    std::vector<int> of_material;
    for (const json& material : document.value("materials", json::array()))
        of_material.push_back(image_of_material(document, material, where));
    std::set<int> used(of_material.begin(), of_material.end());
    used.erase(-1);
    if (used.empty()) {
        throw InputError(where,
                         "has no material with a baseColorTexture; name an image as the map's "
                         "file");
    }
    TextureReader reader(gltf, document, images);
    if (used.size() == 1) return {reader.read(*used.begin()), {}};
    return laid_side_by_side(reader, {used.begin(), used.end()}, of_material, where);
}

}  // namespace sonarsim
