#include "input/scene/gltf/load.h"

#include "core/error.h"
#include "core/text.h"
#include "input/scene/copies.h"
#include "input/scene/gltf/primitives.h"
#include "input/scene/gltf/repeats.h"
#include "input/scene/heightmap/height_model.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/objects.h"
#include "input/scene/seabed/bed_model.h"

namespace sonarsim {

namespace {

/// A file larger or smaller than these was probably read in the wrong unit.
constexpr double suspicious_length_m = 1e4;
constexpr double suspicious_smallness_m = 1e-3;

Eigen::Vector3d choose_origin(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return Eigen::Vector3d::Zero();
    // Extents of 100 m and centres at 50 m are common. Without the shift `limit_shift` they would
    // lie exactly on a limit, and the rounding of a moved scene could change the result.
    constexpr double limit_shift = 1e-6;
    double grid = 1.0;
    while (grid < box.sizes().maxCoeff() * (1.0 - limit_shift))
        grid *= 10.0;
    const Eigen::Vector3d cells = box.center() / grid;
    return grid * (cells.array() + 0.5 + limit_shift).floor().matrix();
}

/// Warns once for each file and unit if the file is implausibly long or short.
void warn_of_unit(const OpenFile& file, const Eigen::AlignedBox3d& box,
                  std::set<std::pair<std::string, double>>& warned, Scene& scene) {
    if (box.isEmpty()) return;
    const double length_m = box.sizes().maxCoeff();
    if (length_m < suspicious_length_m && length_m > suspicious_smallness_m) return;
    const std::string path = file.placed->file.string();
    if (!warned.emplace(path, file.placed->unit_m).second) return;
    scene.warnings.push_back(fmt::format(
        "{} is {:.4g} m long; if that is wrong, set its {}", path, length_m,
        file.placed->heightmap ? "`pixel_m` or `height_scale`" : "`units`, as in units: mm"));
}

/// Finds the extents of the files, and from them the origin of the scene.
std::vector<SurfaceExtent> find_extents(const std::vector<OpenFile>& open, const Repeats& repeats,
                                        ReadingLimit& limit, Scene& scene) {
    std::vector<SurfaceExtent> extents;
    Eigen::AlignedBox3d whole;
    std::set<std::pair<std::string, double>> warned;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const RepeatedFile* const repeated = repeats.by_file[i];
        const SurfaceExtent& extent =
            extents.emplace_back(repeated ? moved(repeated->extent, open[i].placed->T_world_file)
                                          : find_extent(open[i], limit));
        warn_of_unit(open[i], extent.box, warned, scene);
        scene.vertex_rounding_m = std::max(scene.vertex_rounding_m, extent.vertex_rounding_m);
        if (!open[i].placed->moves) whole.extend(extent.box);
    }
    scene.origin = choose_origin(whole);
    return extents;
}

void set_bounds(const std::vector<SurfaceExtent>& extents, const Repeats& repeats, Scene& scene) {
    Eigen::AlignedBox3d box = box_of(scene.vertices);
    for (std::size_t i = 0; i < extents.size(); ++i) {
        if (!repeats.by_file[i] || extents[i].box.isEmpty()) continue;
        box.extend(extents[i].box.translated(-scene.origin));
    }
    if (box.isEmpty()) return;
    scene.bounds_min = scene.origin + box.min();
    scene.bounds_max = scene.origin + box.max();
}

/// True if the name of a mesh or of its node, also before it was made unique, fits a pattern.
bool is_named(const PlacedMesh& mesh, std::span<const std::string> patterns) {
    return std::ranges::any_of(
        std::array{&mesh.instance, &mesh.own_name, &mesh.node, &mesh.own_node},
        [&](const std::string* name) { return fits_any(patterns, *name); });
}

/// True if all of the mesh's instance is the bottom.
bool is_bottom(const PlacedFile& file, const PlacedMesh& mesh) {
    if (!file.bottom) return false;
    return file.bottom->empty() || (file.name.empty() && is_named(mesh, *file.bottom));
}

/// The class that a file gives to a mesh; "": that of its name. Equal names are of one class.
std::string class_of(const PlacedFile& file, const PlacedMesh& mesh) {
    if (!file.class_name.empty()) return file.class_name;
    if (!mesh.label.empty() || mesh.instance == mesh.own_name) return mesh.label;
    return without_copy_number(mesh.own_name);
}

/// Opens the files and appends the names and classes of their instances to those of `scene`. Names
/// of objects in the mission take precedence, then those of the heightmap or seabed: nodes with the
/// same name get another one. InputError for a name that is taken.
std::vector<OpenFile> open_files(std::span<const PlacedFile> files, SceneFiles& models,
                                 Scene& scene) {
    UniqueNames names;
    for (const PlacedFile& file : files) {
        if (file.name.empty() || names.taken.insert(file.name).second) continue;
        refuse(file.place, "there is an object '{}' already; give each a name of its own",
               printable(file.name));
    }
    // The rules of the mission know the ground by the names of its nodes, so they come first.
    std::vector<OpenFile> open(files.size());
    for (const bool ground : {true, false}) {
        for (std::size_t i = 0; i < files.size(); ++i) {
            const PlacedFile& file = files[i];
            if ((file.heightmap || file.seabed) != ground) continue;
            open[i].placed = &file;
            open[i].model = &models.model(file);
            open[i].meshes = place_meshes(*open[i].model, file, names);
        }
    }
    for (OpenFile& next : open) {
        const PlacedFile& file = *next.placed;
        for (const PlacedMesh& mesh : next.meshes) {
            const bool is_part = !file.name.empty() && !next.instance_of_mesh.empty();
            if (!is_part) {
                scene.instances.push_back(mesh.instance);
                scene.own_names.push_back(mesh.own_name);
                scene.instance_classes.push_back(class_of(file, mesh));
                scene.is_bottom.push_back(is_bottom(file, mesh) ? 1 : 0);
            }
            next.instance_of_mesh.push_back(static_cast<std::uint32_t>(scene.instances.size() - 1));
        }
    }
    return open;
}

/// `materials` has no numbers yet.
Scene compose(std::span<const PlacedFile> files, SceneFiles& models, std::size_t sharing_threshold,
              MaterialNumbers& materials) {
    Scene scene;
    const std::vector<OpenFile> open = open_files(files, models, scene);
    ReadingLimit looked_at;
    const Repeats repeats = find_repeats(open, sharing_threshold, looked_at);
    const std::vector<SurfaceExtent> extents = find_extents(open, repeats, looked_at, scene);
    ReadingLimit limit;
    MeshBuilder<Scene> still{scene, scene.rejects, scene.origin};
    for (std::size_t i = 0; i < open.size(); ++i) {
        const OpenFile& file = open[i];
        if (RepeatedFile* const repeated = repeats.by_file[i]) {
            add_copy(*repeated, file, limit, materials, scene);
            continue;
        }
        Body body;
        MeshBuilder<Body> moving{body, scene.rejects, Eigen::Vector3d::Zero()};
        scene.rejects.skipped_primitives +=
            for_each_primitive(file, limit, [&](const PlacedPrimitive& primitive) {
                const std::uint32_t material = materials.of(primitive, scene);
                take_class_of_material(primitive, scene.instance_classes[primitive.instance]);
                if (file.placed->moves) {
                    moving.add(primitive, [&] { body.triangle_material.push_back(material); });
                    return;
                }
                still.add(primitive, [&] {
                    scene.triangle_material.push_back(material);
                    scene.triangle_instance.push_back(primitive.instance);
                });
            });
        if (i == 0) {
            scene.first_file_triangles = scene.triangles.size();
            scene.first_file_vertices = scene.vertices.size();
        }
        if (!file.placed->moves) continue;
        body.instance = file.instance_of_mesh.front();
        scene.bodies.push_back(std::move(body));
    }
    set_bounds(extents, repeats, scene);
    return scene;
}

/// InputError, with the place in the mission, for a material that the table lacks.
void require_materials(std::span<const PlacedFile> files, const MaterialTable& table) {
    for (const PlacedFile& file : files) {
        if (!file.material.empty()) require_material(table, file.material, file.place);
        if (file.seabed) {
            for (const std::string& material : materials_of(*file.seabed))
                require_material(table, material, file.place);
        }
    }
}

/// Adds the mixtures of a bed. The mean grain size in phi of a mixture is the mean by mass, and so
/// are its other numbers (rule); materials without a grain size do not mix.
void add_mixtures(const Seabed& bed, MaterialTable& table) {
    for (const BedMixture& mixture : mixtures_of(bed)) {
        const Material a = *find_material(table.materials, bed.materials[mixture.first]);
        const Material b = *find_material(table.materials, bed.materials[mixture.first + 1]);
        Material& mixed = table.materials.emplace_back(mixture.share < 0.5 ? a : b);
        mixed.prevails = mixed.name;
        mixed.name = mixture.name;
        if (!a.grain_phi || !b.grain_phi) continue;
        const auto mean = [&](double x, double y) { return x + mixture.share * (y - x); };
        mixed.grain_phi = mean(*a.grain_phi, *b.grain_phi);
        mixed.density_kg_m3 = mean(a.density_kg_m3, b.density_kg_m3);
        mixed.sound_speed_m_s = mean(a.sound_speed_m_s, b.sound_speed_m_s);
    }
}

/// Adds the materials that mixtures have as their label, which need not occur by themselves.
void add_prevailing(const MaterialTable& table, Scene& scene, std::vector<std::string>& users) {
    const std::size_t own = scene.materials.size();
    for (std::size_t k = 0; k < own; ++k) {
        const Material* const row = find_material(table.materials, scene.materials[k].name);
        if (!row || row->prevails.empty() || find_material(scene.materials, row->prevails))
            continue;
        scene.materials.emplace_back().name = row->prevails;
        users.emplace_back();
    }
}

tinygltf::Model read_model(const PlacedFile& placed) {
    if (placed.seabed) return bed_model(*placed.seabed);
    if (placed.heightmap) return height_model(placed.file, *placed.heightmap);
    return is_mesh_file(placed.file) ? read_mesh(placed.file) : read_gltf(placed.file);
}

}  // namespace

struct SceneFiles::Entry {
    std::filesystem::path file;
    std::optional<HeightmapRule> heightmap;
    std::shared_ptr<const Seabed> seabed;
    tinygltf::Model model;

    bool is_ground() const { return heightmap || seabed; }
};

const tinygltf::Model& SceneFiles::model(const PlacedFile& placed) {
    for (const auto& entry : entries_) {
        if (entry->file.native() == placed.file.native() && entry->heightmap == placed.heightmap &&
            entry->seabed == placed.seabed)
            return entry->model;
    }
    const auto entry = std::make_shared<const Entry>(
        Entry{placed.file, placed.heightmap, placed.seabed,
              read_named_at(placed.place, [&] { return read_model(placed); })});
    // Keep only one ground: grounds are large, and each variant of a mission may have its own.
    if (entry->is_ground())
        std::erase_if(entries_, [](const auto& old) { return old->is_ground(); });
    return entries_.emplace_back(entry)->model;
}

Scene load_scene(std::span<const PlacedFile> files, SceneFiles& models, const MaterialTable& table,
                 const std::string& material_default, const Water& water,
                 std::size_t sharing_threshold) {
    require_materials(files, table);
    MaterialTable mixed = table;
    for (const PlacedFile& file : files) {
        if (file.seabed) add_mixtures(*file.seabed, mixed);
    }
    MaterialNumbers materials{.fallback = material_default};
    for (const Material& material : mixed.materials)
        materials.known.insert(material.name);
    Scene scene = compose(files, models, sharing_threshold, materials);
    add_prevailing(mixed, scene, materials.users);
    resolve_materials(scene, mixed, water, materials.users);
    return scene;
}

Scene load_scene_geometry(const PlacedFile& file, SceneFiles& models) {
    MaterialNumbers materials{.nameless_allowed = true};
    return compose({&file, 1}, models, share_nothing, materials);
}

Scene load_scene_geometry(const std::filesystem::path& path) {
    SceneFiles models;
    return load_scene_geometry({.file = path}, models);
}

Surface surface_of(const PlacedFile& file, SceneFiles& models, std::span<const std::string> nodes) {
    PlacedFile by_node = file;
    by_node.name.clear();  // empty, so that meshes have the names of their nodes
    UniqueNames names;
    OpenFile open{&by_node, &models.model(file), {}, {}};
    open.meshes = place_meshes(*open.model, by_node, names);
    for (const std::string& pattern : nodes) {
        if (std::ranges::any_of(open.meshes, [&](const PlacedMesh& mesh) {
                return is_named(mesh, {&pattern, 1});
            }))
            continue;
        refuse(file.place,
               "bottom: no node of {} fits '{}'; `sonarsim inspect` lists the names of its nodes",
               file.file.string(), pattern);
    }
    std::erase_if(open.meshes,
                  [&](const PlacedMesh& mesh) { return !nodes.empty() && !is_named(mesh, nodes); });
    open.instance_of_mesh.assign(open.meshes.size(), 0);
    Surface surface;
    SceneRejects rejects;
    MeshBuilder<Surface> builder{surface, rejects, Eigen::Vector3d::Zero()};
    ReadingLimit limit;
    for_each_primitive(open, limit,
                       [&](const PlacedPrimitive& primitive) { builder.add(primitive, [] {}); });
    return surface;
}

}  // namespace sonarsim
