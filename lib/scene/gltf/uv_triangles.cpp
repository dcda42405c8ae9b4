#include "scene/gltf/uv_triangles.h"

#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf/load.h"
#include "scene/gltf/primitives.h"

namespace sonarsim {

namespace {

/// The part of the image that lies on a primitive; nothing if there is none. A single image needs
/// no bounds: coordinates beyond it lie outside the map.
std::optional<Eigen::AlignedBox2d> part_of(const PlacedPrimitive& primitive,
                                           const TextureParts& parts) {
    if (parts.of_material.empty()) return UvTriangle::everywhere();
    if (primitive.file.placed->file != parts.file) {
        throw InputError(primitive.where + " of node '" + printable(primitive.mesh.instance) +
                         "' is not of " + parts.file.string() +
                         ", whose images lie on its own materials; name its nodes as instances");
    }
    const auto material = static_cast<std::size_t>(primitive.material);
    return material < parts.of_material.size() ? parts.of_material[material] : std::nullopt;
}

void add_triangles(const PlacedPrimitive& primitive, const TextureParts& parts,
                   std::vector<UvTriangle>& out) {
    const std::string& where = primitive.where;
    const std::optional<Eigen::AlignedBox2d> part = part_of(primitive, parts);
    if (!part) return;
    if (primitive.texcoord < 0) {
        throw InputError(where + " of node '" + printable(primitive.mesh.instance) +
                         "' has no TEXCOORD_0, by which a map is placed with placed: uv; unwrap "
                         "the mesh in its editor, or place the map from above");
    }
    const Accessor uv =
        open_texcoords(*primitive.file.model, primitive.texcoord, where + ": TEXCOORD_0");
    if (uv.count != primitive.source.positions.count) {
        throw InputError(where + ": TEXCOORD_0 has " + std::to_string(uv.count) +
                         " elements, and POSITION has " +
                         std::to_string(primitive.source.positions.count));
    }
    for (std::size_t i = 0; i < primitive.source.count; ++i) {
        const std::array<std::uint32_t, 3> vertices = triangle(primitive.source, i, where);
        UvTriangle& next = out.emplace_back();
        next.instance = primitive.instance;
        next.image = *part;
        bool finite = true;
        for (std::size_t k = 0; k < 3; ++k) {
            next.corners[k] = corner(primitive, vertices[k]);
            next.uv[k] = texcoord(uv, vertices[k]);
            if (!parts.of_material.empty())
                next.uv[k] = part->min() + next.uv[k].cwiseProduct(part->sizes());
            finite = finite && next.corners[k].allFinite() && next.uv[k].allFinite();
        }
        if (!finite) out.pop_back();
    }
}

}  // namespace

std::vector<UvTriangle> uv_triangles(std::span<const PlacedFile> files, SceneFiles& models,
                                     std::span<const char> on, const TextureParts& parts) {
    Scene names;
    std::vector<UvTriangle> out;
    ReadingLimit limit;
    for (const OpenFile& file : open_files(files, models, names)) {
        for_each_primitive(file, limit, [&](const PlacedPrimitive& primitive) {
            if (on[primitive.instance] != 0) add_triangles(primitive, parts, out);
        });
    }
    return out;
}

}  // namespace sonarsim
