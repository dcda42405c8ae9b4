#include "trace/target_shapes.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

#include "core/groups.h"
#include "scene/maps/ground_maps.h"
#include "scene/materials.h"
#include "scene/mesh_topology.h"

namespace sonarsim {

namespace {

// With more triangles an object would take longer than the rest of a ping.
constexpr std::size_t max_target_triangles = 20'000;
constexpr float max_target_radius_m = 5.0F;

/// Adds the shape of a mesh, if it may be a target, and returns its index.
std::optional<std::uint32_t> add_shape(const TargetMesh& mesh, float scale, TargetShapes& out) {
    if (mesh.triangles.empty() || mesh.triangles.size() > max_target_triangles) return std::nullopt;
    const float radius_m = ball_around(mesh.vertices, mesh.triangles).radius_m;
    if (scale * radius_m > max_target_radius_m) return std::nullopt;
    out.shapes.push_back(target_shape(mesh));
    return static_cast<std::uint32_t>(out.shapes.size() - 1);
}

void add_instances(const Scene& scene, TargetShapes& out) {
    const Groups groups = sort_into_groups(scene.triangle_instance, scene.instances.size());
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const std::span<const std::uint32_t> triangles(
            groups.items.data() + groups.begin[instance],
            groups.items.data() + groups.begin[instance + 1]);
        if (triangles.size() > max_target_triangles) continue;
        TargetMesh mesh{.vertices = scene.vertices, .triangles = {}, .materials = {}};
        for (const std::uint32_t t : triangles) {
            mesh.triangles.push_back(scene.triangles[t]);
            mesh.materials.push_back(scene.triangle_material[t]);
        }
        const std::optional<std::uint32_t> shape = add_shape(mesh, 1.0F, out);
        if (shape) out.placed.push_back({*shape, instance, {}, Eigen::Affine3f::Identity()});
    }
}

void add_bodies(const Scene& scene, TargetShapes& out) {
    for (std::uint32_t k = 0; k < scene.bodies.size(); ++k) {
        const Body& body = scene.bodies[k];
        const std::optional<std::uint32_t> shape =
            add_shape({body.vertices, body.triangles, body.triangle_material}, 1.0F, out);
        if (shape) out.placed.push_back({*shape, body.instance, k, Eigen::Affine3f::Identity()});
    }
}

void add_copies(const Scene& scene, TargetShapes& out) {
    std::map<std::uint32_t, std::optional<std::uint32_t>> shape_of_mesh;
    for (const MeshCopy& copy : scene.copies) {
        const auto [place, is_new] = shape_of_mesh.try_emplace(copy.mesh);
        const auto scale = static_cast<float>(copy.T_world_mesh.linear().col(0).norm());
        if (is_new) {
            const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
            place->second =
                add_shape({mesh.vertices, mesh.triangles, mesh.triangle_material}, 0.0F, out);
        }
        if (!place->second || scale * out.shapes[*place->second].radius_m > max_target_radius_m)
            continue;
        Eigen::Affine3d T_local_mesh = copy.T_world_mesh;
        T_local_mesh.translation() -= scene.origin;
        out.placed.push_back({*place->second, copy.instance, {}, T_local_mesh.cast<float>()});
    }
}

/// Lessens a slope to that of a material, if the material has facets.
void lessen(float& slope, const Material& material) {
    const auto of_material = static_cast<float>(facet_slope(material));
    if (of_material > 0.0F) slope = std::min(slope, of_material);
}

}  // namespace

std::shared_ptr<const TargetShapes> find_target_shapes(const Scene& scene) {
    auto out = std::make_shared<TargetShapes>();
    add_instances(scene, *out);
    add_bodies(scene, *out);
    add_copies(scene, *out);
    if (out->placed.empty()) return nullptr;
    std::vector<float> slopes(out->shapes.size(), 1.0F);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        for (const TargetTriangle& triangle : out->shapes[k].triangles)
            lessen(slopes[k], scene.materials[triangle.material]);
    }
    for (PlacedTarget& placed : out->placed) {
        placed.min_slope = slopes[placed.shape];
        if (!scene.maps || !scene.maps->lie_on(placed.instance)) continue;
        for (const std::uint32_t material : scene.maps->materials())
            lessen(placed.min_slope, scene.materials[material]);
    }
    return out;
}

}  // namespace sonarsim
