#include "scene/gltf/load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/input_limits.h"
#include "core/text.h"
#include "scene/gltf/pieces.h"

namespace sonarsim {

namespace {

/// Beyond these a file is probably not in the unit that it is read in.
constexpr double suspicious_length_m = 1e4;
constexpr double suspicious_smallness_m = 1e-3;

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

Extent find_extent(const OpenFile& file, ReadingLimit& limit) {
    Extent extent;
    for_each_piece(file, limit, [&extent](const Piece& piece) {
        Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  // in the mesh's own axes
        for (std::size_t i = 0; i < piece.source.count; ++i) {
            const auto vertices = triangle(piece.source, i, piece.where);
            std::array<Eigen::Vector3d, 3> points;
            Eigen::Vector3d reach = Eigen::Vector3d::Zero();
            for (int k = 0; k < 3; ++k) {
                points[k] = position(piece.source.positions, vertices[k]);
                reach = reach.cwiseMax(points[k].cwiseAbs());
                points[k] = piece.mesh.T_world_mesh * points[k];
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
            piece.mesh.T_world_mesh.linear().cwiseAbs() * farthest.unaryExpr(&half_unit);
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

/// Adds triangles to a scene or a body, vertex by vertex as triangles ask for them.
template <class Mesh>
struct MeshBuilder {
    Mesh& mesh;
    SceneRejects& rejects;
    Eigen::Vector3d origin;
    // Where a piece's vertex stands in `mesh.vertices`, plus 1. What earlier pieces left is not
    // above their number of vertices, so nothing has to be cleared.
    std::vector<std::uint32_t> slots = {};

    /// Calls `note` for every triangle that is added.
    template <class Note>
    void add(const Piece& piece, const Note& note) {
        const std::size_t first = mesh.vertices.size();
        slots.resize(std::max(slots.size(), piece.source.positions.count), 0);
        for (std::size_t i = 0; i < piece.source.count; ++i) {
            std::array<std::uint32_t, 3> vertices = triangle(piece.source, i, piece.where);
            std::array<Eigen::Vector3f, 3> local;
            std::array<Eigen::Vector3d, 3> rounded;
            for (std::size_t k = 0; k < 3; ++k) {
                local[k] = (corner(piece, vertices[k]) - origin).template cast<float>();
                rounded[k] = local[k].template cast<double>();
            }
            if (!is_finite(rounded)) {
                ++rejects.non_finite_triangles;
                continue;
            }
            if (!has_area(rounded)) {
                ++rejects.degenerate_triangles;
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& slot = slots[vertices[k]];
                if (slot <= first) {
                    mesh.vertices.push_back(local[k]);
                    slot = static_cast<std::uint32_t>(mesh.vertices.size());
                }
                vertices[k] = slot - 1;
            }
            mesh.triangles.push_back(vertices);
            note();
        }
    }
};

/// Numbers the materials of a scene in the order in which they come.
struct MaterialNumbers {
    std::map<std::string, std::uint32_t> numbers = {};

    std::uint32_t of(const std::string& name, Scene& scene) {
        const auto number = static_cast<std::uint32_t>(scene.materials.size());
        const auto [entry, is_new] = numbers.emplace(name, number);
        if (is_new) {
            scene.materials.emplace_back();
            scene.materials.back().name = name;
        }
        return entry->second;
    }
};

/// Opens the files and names their instances. Names that objects are given come first: what nodes
/// are called gives way to them.
std::vector<OpenFile> open_files(std::span<const PlacedFile> files, SceneFiles& models,
                                 Scene& scene) {
    UniqueNames names;
    for (const PlacedFile& file : files) {
        if (file.name.empty() || names.taken.insert(file.name).second) continue;
        throw InputError(file.place, "there is an object '" + printable(file.name) +
                                         "' already; give each a name of its own");
    }
    std::vector<OpenFile> open;
    for (const PlacedFile& file : files) {
        OpenFile& next = open.emplace_back();
        next.placed = &file;
        next.model = &models.model(file.file);
        next.meshes = place_meshes(*next.model, file, names);
        if (next.meshes.empty() && !file.name.empty()) {
            throw InputError(file.place, "nothing of " + file.file.string() + " is left for '" +
                                             printable(file.name) + "'");
        }
        for (const PlacedMesh& mesh : next.meshes) {
            const bool is_part = !file.name.empty() && !next.instance_of_mesh.empty();
            if (!is_part) {
                scene.instances.push_back(mesh.instance);
                scene.instance_classes.push_back(file.class_name.empty() ? mesh.label
                                                                         : file.class_name);
            }
            next.instance_of_mesh.push_back(static_cast<std::uint32_t>(scene.instances.size() - 1));
        }
    }
    return open;
}

/// Once for each file that is read in one unit.
void doubt_units(const OpenFile& file, const Eigen::AlignedBox3d& box,
                 std::set<std::pair<std::string, double>>& doubted, Scene& scene) {
    if (box.isEmpty()) return;
    const double length_m = box.sizes().maxCoeff();
    if (length_m < suspicious_length_m && length_m > suspicious_smallness_m) return;
    const std::string path = file.placed->file.string();
    if (!doubted.emplace(path, file.placed->unit_m).second) return;
    scene.doubts.push_back(path + " is " + number_text(length_m) +
                           " m long; if its lengths are not what they are read as, say what they "
                           "are with `units`, as in units: mm");
}

void find_extents(const std::vector<OpenFile>& open, Scene& scene) {
    Eigen::AlignedBox3d whole;
    ReadingLimit limit;
    std::set<std::pair<std::string, double>> doubted;
    for (const OpenFile& file : open) {
        require_renamed(file);
        const Extent extent = find_extent(file, limit);
        doubt_units(file, extent.box, doubted, scene);
        scene.vertex_rounding_m = std::max(scene.vertex_rounding_m, extent.vertex_rounding_m);
        if (!file.placed->moves) whole.extend(extent.box);
    }
    scene.origin = choose_origin(whole);
}

Scene compose(std::span<const PlacedFile> files, SceneFiles& models, const MaterialRules& rules) {
    Scene scene;
    const std::vector<OpenFile> open = open_files(files, models, scene);
    find_extents(open, scene);
    MaterialNumbers materials;
    ReadingLimit limit;
    MeshBuilder<Scene> still{scene, scene.rejects, scene.origin};
    for (const OpenFile& file : open) {
        Body body;
        MeshBuilder<Body> moving{body, scene.rejects, Eigen::Vector3d::Zero()};
        scene.rejects.skipped_primitives += for_each_piece(file, limit, [&](const Piece& piece) {
            const std::uint32_t material = materials.of(material_name(piece, rules), scene);
            take_class_of_material(piece, scene.instance_classes[piece.instance]);
            if (file.placed->moves) {
                moving.add(piece, [&] { body.triangle_material.push_back(material); });
                return;
            }
            still.add(piece, [&] {
                scene.triangle_material.push_back(material);
                scene.triangle_instance.push_back(piece.instance);
            });
        });
        if (!file.placed->moves) continue;
        body.instance = file.instance_of_mesh.front();
        scene.bodies.push_back(std::move(body));
    }

    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& vertex : scene.vertices)
        box.extend(vertex.cast<double>());
    if (!box.isEmpty()) {
        scene.bounds_min = scene.origin + box.min();
        scene.bounds_max = scene.origin + box.max();
    }
    return scene;
}

/// Materials that the mission names, each where it does so.
void require_materials(std::span<const PlacedFile> files, const MaterialTable& table) {
    std::vector<std::string> known;
    for (const Material& material : table.materials)
        known.push_back(material.name);
    const auto require = [&](const PlacedFile& file, const std::string& name) {
        if (std::ranges::find(known, name) != known.end()) return;
        throw InputError(file.place, "unknown material '" + printable(name) + "'" +
                                         did_you_mean(name, known) + "; " + table.file +
                                         " lists those that there are");
    };
    for (const PlacedFile& file : files) {
        if (!file.material.empty()) require(file, file.material);
        for (const auto& renamed : file.renamed_materials)
            require(file, renamed.second);
    }
}

}  // namespace

Scene load_scene(std::span<const PlacedFile> files, SceneFiles& models, const MaterialTable& table,
                 const std::string& material_default, const Water& water) {
    require_materials(files, table);
    MaterialRules rules;
    rules.fallback = material_default;
    for (const Material& material : table.materials)
        rules.known.insert(material.name);
    Scene scene = compose(files, models, rules);
    resolve_materials(scene, table, water);
    return scene;
}

Scene load_scene(const std::filesystem::path& gltf, const std::filesystem::path& materials_csv,
                 const Water& water) {
    const MaterialTable table = read_materials(materials_csv);
    SceneFiles models;
    const PlacedFile file{.file = gltf};
    return load_scene({&file, 1}, models, table, "", water);
}

Scene load_scene_geometry(const std::filesystem::path& gltf) {
    SceneFiles models;
    const PlacedFile file{.file = gltf};
    return compose({&file, 1}, models, {true, {}, {}});
}

}  // namespace sonarsim
