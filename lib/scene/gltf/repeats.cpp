#include "scene/gltf/repeats.h"

#include <map>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "scene/gltf/extent.h"

namespace sonarsim {

namespace {

/// The settings that decide how a file is read, without its place.
auto reading_of(const PlacedFile& file) {
    return std::tie(file.file, file.unit_m, file.z_up, file.material, file.renamed_materials,
                    file.exclude, file.class_name);
}

struct LessReading {
    bool operator()(const PlacedFile* a, const PlacedFile* b) const {
        return reading_of(*a) < reading_of(*b);
    }
};

std::size_t triangles_of(const OpenFile& file) {
    std::size_t triangles = 0;
    ReadingLimit limit;
    for_each_primitive(file, limit, [&](const PlacedPrimitive& primitive) {
        triangles += primitive.source.count;
    });
    return triangles;
}

/// Adds the file as if placed at the origin. Its class is that of the first copy.
RepeatedFile& add_repeated(const OpenFile& first, std::deque<RepeatedFile>& files) {
    RepeatedFile& repeated = files.emplace_back();
    repeated.placed = *first.placed;
    repeated.placed.T_world_file = Eigen::Affine3d::Identity();
    UniqueNames names;
    repeated.open.placed = &repeated.placed;
    repeated.open.model = first.model;
    repeated.open.meshes = place_meshes(*first.model, repeated.placed, names);
    repeated.open.instance_of_mesh = first.instance_of_mesh;
    return repeated;
}

}  // namespace

Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t sharing_threshold) {
    constexpr std::size_t most_triangles = 0xFFFF0000U;
    std::map<const PlacedFile*, std::vector<std::size_t>, LessReading> alike;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PlacedFile& file = *open[i].placed;
        if (!file.name.empty() && !file.moves) alike[&file].push_back(i);
    }
    std::erase_if(alike, [](const auto& group) { return group.second.size() < 2; });
    std::size_t triangles = 0;
    for (const auto& group : alike)
        triangles += group.second.size() * triangles_of(open[group.second.front()]);
    Repeats repeats;
    repeats.of_file.assign(open.size(), Repeats::none);
    if (triangles <= sharing_threshold) return repeats;
    if (triangles > most_triangles) {
        throw InputError(alike.begin()->first->place,
                         "repeated files have " + std::to_string(triangles) +
                             " triangles together with this one; at most 4294901760 are supported");
    }
    for (const auto& group : alike) {
        add_repeated(open[group.second.front()], repeats.files);
        for (const std::size_t file : group.second)
            repeats.of_file[file] = repeats.files.size() - 1;
    }
    return repeats;
}

SharedMeshes::SharedMeshes(const Repeats& repeats)
    : repeats_(repeats), made_(repeats.files.size()) {}

void SharedMeshes::add_copy(std::size_t repeat, const OpenFile& file, const MaterialRules& rules,
                            ReadingLimit& limit, MaterialNumbers& materials, Scene& scene) {
    Made& made = made_[repeat];
    if (!made.is_made) {
        const OpenFile& source = repeats_.files[repeat].open;
        made.is_made = true;
        made.mesh = static_cast<std::uint32_t>(scene.shared_meshes.size());
        made.class_name = scene.instance_classes[source.instance_of_mesh.front()];
        ReadingLimit looked_at;
        const Eigen::AlignedBox3d box = find_extent(source, looked_at).box;
        if (!box.isEmpty()) made.centre = box.center();
        SharedMesh& mesh = scene.shared_meshes.emplace_back();
        MeshBuilder<SharedMesh> builder{mesh, scene.rejects, made.centre};
        scene.rejects.skipped_primitives +=
            for_each_primitive(source, limit, [&](const PlacedPrimitive& primitive) {
                const std::uint32_t material = materials.of(primitive, rules, scene);
                take_class_of_material(primitive, made.class_name);
                builder.add(primitive, [&] { mesh.triangle_material.push_back(material); });
            });
    }
    const std::uint32_t instance = file.instance_of_mesh.front();
    scene.instance_classes[instance] = made.class_name;
    scene.copies.push_back(
        {made.mesh, instance, file.placed->T_world_file * Eigen::Translation3d(made.centre)});
}

}  // namespace sonarsim
