#include "scene/gltf/surface_of.h"

#include <algorithm>

#include "scene/gltf/primitives.h"
#include "scene/objects.h"

namespace sonarsim {

namespace {

void add_primitive(const PlacedPrimitive& primitive, Surface& surface) {
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    for (std::size_t i = 0; i < primitive.source.positions.count; ++i)
        surface.vertices.push_back(corner(primitive, static_cast<std::uint32_t>(i)));
    for (std::size_t i = 0; i < primitive.source.count; ++i) {
        std::array<std::uint32_t, 3> corners = triangle(primitive.source, i, primitive.where);
        bool finite = true;
        for (std::uint32_t& c : corners) {
            c += first;
            finite = finite && surface.vertices[c].allFinite();
        }
        if (finite) surface.triangles.push_back(corners);
    }
}

/// The surface without unused vertices.
Surface compact(const Surface& surface) {
    constexpr std::uint32_t unused = 0xFFFFFFFFU;
    std::vector<std::uint32_t> slots(surface.vertices.size(), unused);
    Surface out;
    for (const auto& corners : surface.triangles) {
        std::array<std::uint32_t, 3>& own = out.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& slot = slots[corners[k]];
            if (slot == unused) {
                slot = static_cast<std::uint32_t>(out.vertices.size());
                out.vertices.push_back(surface.vertices[corners[k]]);
            }
            own[k] = slot;
        }
    }
    return out;
}

}  // namespace

Surface surface_of(const PlacedFile& file, SceneFiles& models, std::span<const std::string> nodes) {
    PlacedFile by_node = file;
    by_node.name.clear();  // empty, so that meshes have the names of their nodes
    UniqueNames names;
    OpenFile open{&by_node, &models.model(file), {}, {}};
    open.meshes = place_meshes(*open.model, by_node, names);
    for (const std::string& pattern : nodes) {
        if (std::ranges::any_of(open.meshes, [&](const PlacedMesh& mesh) {
                return fits_pattern(pattern, mesh.instance);
            }))
            continue;
        throw InputError(file.place, "bottom: no node of " + file.file.string() + " fits '" +
                                         pattern +
                                         "'; `sonarsim inspect` lists the names of its nodes");
    }
    std::erase_if(open.meshes, [&](const PlacedMesh& mesh) {
        return !nodes.empty() && std::ranges::none_of(nodes, [&](const std::string& pattern) {
            return fits_pattern(pattern, mesh.instance);
        });
    });
    open.instance_of_mesh.assign(open.meshes.size(), 0);
    Surface surface;
    ReadingLimit limit;
    for_each_primitive(
        open, limit, [&](const PlacedPrimitive& primitive) { add_primitive(primitive, surface); });
    return compact(surface);
}

}  // namespace sonarsim
