#include "scene/gltf/surface_of.h"

#include <algorithm>

#include "scene/gltf/primitives.h"
#include "scene/objects.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t unused = 0xFFFFFFFFU;

/// Adds triangles and the vertices that they use. Unused vertices are left out, since a small file
/// can claim any number of them. Every entry of `slots` is `unused` before and after the call.
void add_primitive(const PlacedPrimitive& primitive, std::vector<std::uint32_t>& slots,
                   Surface& surface) {
    slots.resize(std::max(slots.size(), primitive.source.positions.count), unused);
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < primitive.source.count; ++i) {
        std::array<std::uint32_t, 3> corners = triangle(primitive.source, i, primitive.where);
        const bool finite = std::ranges::all_of(
            corners, [&](std::uint32_t c) { return corner(primitive, c).allFinite(); });
        if (!finite) continue;
        for (std::uint32_t& c : corners) {
            if (slots[c] == unused) {
                slots[c] = static_cast<std::uint32_t>(surface.vertices.size());
                surface.vertices.push_back(corner(primitive, c));
                used.push_back(c);
            }
            c = slots[c];
        }
        surface.triangles.push_back(corners);
    }
    for (const std::uint32_t c : used)
        slots[c] = unused;
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
    std::vector<std::uint32_t> slots;
    for_each_primitive(open, limit, [&](const PlacedPrimitive& primitive) {
        add_primitive(primitive, slots, surface);
    });
    return surface;
}

}  // namespace sonarsim
