#include "scene/gltf/load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/input_limits.h"
#include "scene/gltf/file.h"
#include "scene/gltf/nodes.h"
#include "scene/gltf/triangles.h"
#include "scene/materials.h"

namespace sonarsim {

namespace {

// A small file can place a large mesh, or many small ones, many times.
constexpr std::size_t max_triangles = std::size_t{1} << 28;
constexpr std::size_t piece_cost = 64;

enum class Nameless { refused, allowed };

/// One primitive of one placed mesh.
struct Piece {
    const TriangleSource& source;
    const PlacedMesh& placed;
    std::size_t instance;
    int material;       ///< of the glTF; -1: none
    std::string where;  ///< for errors
};

Eigen::Vector3d corner(const Piece& piece, std::uint32_t vertex) {
    return piece.placed.T_world_mesh * position(piece.source.positions, vertex);
}

/// Calls `visit` with every piece of the scene and returns how many primitives are no surfaces.
template <class Visit>
std::uint64_t for_each_piece(const tinygltf::Model& model, const std::vector<PlacedMesh>& placed,
                             const std::string& file, Visit visit) {
    std::uint64_t skipped = 0;
    std::size_t work = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto mesh_index = static_cast<std::size_t>(placed[i].mesh);
        const tinygltf::Mesh& mesh = model.meshes[mesh_index];
        const std::string name =
            mesh.name.empty() ? std::to_string(mesh_index) : "'" + mesh.name + "'";
        const std::string prefix = file + ": mesh " + name + " primitive ";
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            const std::string where = prefix + std::to_string(k);
            const auto source = open_triangles(model, mesh.primitives[k], where);
            work += piece_cost;
            if (source) work += source->count + source->positions.sparse_at.size();
            if (work > max_triangles) {
                throw InputError(Location{file},
                                 "places more than 2^28 triangles (a primitive counts as 64 more)");
            }
            if (source) {
                visit(Piece{*source, placed[i], i, mesh.primitives[k].material, where});
            } else {
                ++skipped;
            }
        }
    }
    return skipped;
}

bool has_area(const std::array<Eigen::Vector3d, 3>& p) {
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm() > 0.0;
}

bool is_finite(const std::array<Eigen::Vector3d, 3>& p) {
    return p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
}

/// By how much a float of this size may be off for being a float: half a unit in the last place.
double half_unit(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return x == 0.0 ? 0.0 : std::ldexp(1.0, exponent - 25);
}

struct Extent {
    /// Around the triangles that have an area, before any rounding of ours.
    Eigen::AlignedBox3d box;
    double vertex_rounding_m = 0.0;  ///< as in Scene
};

Extent find_extent(const tinygltf::Model& model, const std::vector<PlacedMesh>& placed,
                   const std::string& file) {
    Extent extent;
    for_each_piece(model, placed, file, [&extent](const Piece& piece) {
        Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  // in the mesh's own axes
        for (std::size_t i = 0; i < piece.source.count; ++i) {
            const auto vertices = triangle(piece.source, i, piece.where);
            std::array<Eigen::Vector3d, 3> points;
            Eigen::Vector3d reach = Eigen::Vector3d::Zero();
            for (int k = 0; k < 3; ++k) {
                points[k] = position(piece.source.positions, vertices[k]);
                reach = reach.cwiseMax(points[k].cwiseAbs());
                points[k] = piece.placed.T_world_mesh * points[k];
            }
            if (!is_finite(points) || !has_area(points)) continue;
            farthest = farthest.cwiseMax(reach);
            for (const Eigen::Vector3d& point : points) {
                if (point.cwiseAbs().maxCoeff() > furthest_m) {
                    throw InputError(piece.where +
                                     ": a vertex lies more than 1e8 m from the origin");
                }
                extent.box.extend(point);
            }
        }
        // Integers are what their exporter made them.
        if (piece.source.positions.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
        const Eigen::Vector3d off =
            piece.placed.T_world_mesh.linear().cwiseAbs() * farthest.unaryExpr(&half_unit);
        extent.vertex_rounding_m = std::max(extent.vertex_rounding_m, off.maxCoeff());
    });
    return extent;
}

Eigen::Vector3d choose_origin(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return Eigen::Vector3d::Zero();
    // Sizes such as 100 m and centres such as 50 m are common and would sit on the edge of a
    // decision, where the rounding of a moved scene could tip it; so the edges stand aside.
    constexpr double aside = 1e-6;
    double grid = 1.0;
    while (grid < box.sizes().maxCoeff() * (1.0 - aside))
        grid *= 10.0;
    const Eigen::Vector3d cells = box.center() / grid;
    return grid * (cells.array() + 0.5 + aside).floor().matrix();
}

std::string material_name(const tinygltf::Model& model, const Piece& piece, Nameless nameless) {
    if (!piece.placed.material.empty()) return piece.placed.material;
    if (piece.material >= 0) {
        const auto index = static_cast<std::size_t>(piece.material);
        if (index >= model.materials.size()) {
            throw InputError(piece.where + ": material " + std::to_string(index) +
                             " does not exist");
        }
        const tinygltf::Material& material = model.materials[index];
        std::string own = sonar_material(material.extras);
        if (!own.empty()) return own;
        if (!material.name.empty()) return material.name;
    }
    if (nameless == Nameless::allowed) return "(no material)";
    throw InputError(piece.where + " of node '" + piece.placed.instance +
                     "': " + (piece.material < 0 ? "has no material" : "its material has no name") +
                     "; name one in the glTF material or as extras.sonar.material of the node");
}

/// The class of a placed mesh that has none of its own: that of its materials, or "".
void take_class_of_material(const tinygltf::Model& model, const Piece& piece,
                            std::string& class_name) {
    if (!piece.placed.label.empty() || piece.material < 0) return;
    const auto index = static_cast<std::size_t>(piece.material);
    if (index >= model.materials.size()) return;  // refused where the material is looked up
    const std::string own = sonar_class(model.materials[index].extras);
    if (own.empty() || own == class_name) return;
    if (!class_name.empty()) {
        throw InputError(piece.where + " of node '" + piece.placed.instance +
                         "': its material has the class '" + own + "', another of the node's '" +
                         class_name + "'; give the node a class as its extras.sonar.class");
    }
    class_name = own;
}

/// Fills a scene, vertex by vertex as triangles ask for them.
struct SceneBuilder {
    Scene scene;
    std::map<std::string, std::uint32_t> materials;
    // Where a piece's vertex stands in `scene.vertices`, plus 1. What earlier pieces left is not
    // above their number of vertices, so nothing has to be cleared.
    std::vector<std::uint32_t> slots;

    std::uint32_t material(const std::string& name) {
        const auto number = static_cast<std::uint32_t>(scene.materials.size());
        const auto [entry, is_new] = materials.emplace(name, number);
        if (is_new) {
            scene.materials.emplace_back();
            scene.materials.back().name = name;
        }
        return entry->second;
    }

    void add(const Piece& piece, std::uint32_t material_index) {
        const std::size_t first = scene.vertices.size();
        slots.resize(std::max(slots.size(), piece.source.positions.count), 0);
        for (std::size_t i = 0; i < piece.source.count; ++i) {
            std::array<std::uint32_t, 3> vertices = triangle(piece.source, i, piece.where);
            std::array<Eigen::Vector3f, 3> local;
            std::array<Eigen::Vector3d, 3> rounded;
            for (std::size_t k = 0; k < 3; ++k) {
                local[k] = (corner(piece, vertices[k]) - scene.origin).cast<float>();
                rounded[k] = local[k].cast<double>();
            }
            if (!is_finite(rounded)) {
                ++scene.rejects.non_finite_triangles;
                continue;
            }
            if (!has_area(rounded)) {
                ++scene.rejects.degenerate_triangles;
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& slot = slots[vertices[k]];
                if (slot <= first) {
                    scene.vertices.push_back(local[k]);
                    slot = static_cast<std::uint32_t>(scene.vertices.size());
                }
                vertices[k] = slot - 1;
            }
            scene.triangles.push_back(vertices);
            scene.triangle_material.push_back(material_index);
            scene.triangle_instance.push_back(static_cast<std::uint32_t>(piece.instance));
        }
    }
};

Scene read_scene(const std::filesystem::path& path, Nameless nameless) {
    const std::string file = path.string();
    const tinygltf::Model model = read_gltf(path);
    const std::vector<PlacedMesh> placed = place_meshes(model, file);

    SceneBuilder builder;
    Scene& scene = builder.scene;
    const Extent extent = find_extent(model, placed, file);
    scene.origin = choose_origin(extent.box);
    scene.vertex_rounding_m = extent.vertex_rounding_m;
    for (const PlacedMesh& mesh : placed) {
        scene.instances.push_back(mesh.instance);
        scene.instance_classes.push_back(mesh.label);
    }
    scene.rejects.skipped_primitives = for_each_piece(model, placed, file, [&](const Piece& piece) {
        builder.add(piece, builder.material(material_name(model, piece, nameless)));
        take_class_of_material(model, piece, scene.instance_classes[piece.instance]);
    });

    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& vertex : scene.vertices)
        box.extend(vertex.cast<double>());
    if (!box.isEmpty()) {
        scene.bounds_min = scene.origin + box.min();
        scene.bounds_max = scene.origin + box.max();
    }
    return std::move(scene);
}

}  // namespace

Scene load_scene(const std::filesystem::path& gltf, const std::filesystem::path& materials_csv,
                 const Water& water) {
    const MaterialTable table = read_materials(materials_csv);
    Scene scene = read_scene(gltf, Nameless::refused);
    resolve_materials(scene, table, water);
    return scene;
}

Scene load_scene_geometry(const std::filesystem::path& gltf) {
    return read_scene(gltf, Nameless::allowed);
}

}  // namespace sonarsim
