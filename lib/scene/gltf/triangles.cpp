#include "scene/gltf/triangles.h"

#include "core/error.h"

namespace sonarsim {

std::optional<TriangleSource> open_triangles(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const std::string& where) {
    if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        throw InputError(where + ": mode " + std::to_string(primitive.mode) +
                         " is not one of glTF's, 0 to 6");
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return std::nullopt;
    const auto attribute = primitive.attributes.find("POSITION");
    if (attribute == primitive.attributes.end()) throw InputError(where + ": has no POSITION");

    TriangleSource source;
    source.mode = primitive.mode;
    source.positions = open_positions(model, attribute->second, where + ": POSITION");
    if (primitive.indices >= 0) {
        source.indices = open_indices(model, primitive.indices, where + ": indices");
    }
    const std::size_t corners = source.indices ? source.indices->count : source.positions.count;
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (is_list ? corners % 3 != 0 : corners < 3) {
        throw InputError(where + ": " + std::to_string(corners) +
                         " corners do not make whole triangles");
    }
    source.count = is_list ? corners / 3 : corners - 2;
    return source;
}

std::array<std::uint32_t, 3> triangle(const TriangleSource& source, std::size_t i,
                                      const std::string& where) {
    std::array<std::size_t, 3> corners{i, i + 1, i + 2};
    if (source.mode == TINYGLTF_MODE_TRIANGLES) corners = {3 * i, 3 * i + 1, 3 * i + 2};
    if (source.mode == TINYGLTF_MODE_TRIANGLE_FAN) corners[0] = 0;

    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t k = 0; k < 3; ++k) {
        vertices[k] = source.indices ? vertex_index(*source.indices, corners[k])
                                     : static_cast<std::uint32_t>(corners[k]);
        if (vertices[k] >= source.positions.count) {
            throw InputError(where + ": index " + std::to_string(vertices[k]) +
                             " is out of range; there are " +
                             std::to_string(source.positions.count) + " vertices");
        }
    }
    return vertices;
}

}  // namespace sonarsim
