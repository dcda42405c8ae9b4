#include "input/scene/gltf/repeats.h"

#include <cmath>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/input_limits.h"

namespace sonarsim {

namespace {

/// The rounding of a float of this size: half a unit in the last place.
double half_unit(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return x == 0.0 ? 0.0 : std::ldexp(1.0, exponent - 25);
}

/// The settings that decide how a file is read, without its place.
auto settings_of(const PlacedFile& file) {
    return std::tie(file.file, file.unit_m, file.z_up, file.material, file.class_name);
}

std::size_t triangles_of(const OpenFile& file) {
    std::size_t triangles = 0;
    ReadingLimit limit;
    for_each_primitive(file, limit, [&](const PlacedPrimitive& primitive) {
        triangles += primitive.triangles.size();
    });
    return triangles;
}

void add_repeated_mesh(RepeatedFile& repeated, ReadingLimit& limit, MaterialNumbers& materials,
                       Scene& scene) {
    repeated.mesh = static_cast<std::uint32_t>(scene.shared_meshes.size());
    repeated.class_name = scene.instance_classes[repeated.open.instance_of_mesh.front()];
    SharedMesh& mesh = scene.shared_meshes.emplace_back();
    MeshBuilder<SharedMesh> builder{mesh, scene.rejects, repeated.extent.centre()};
    scene.rejects.skipped_primitives +=
        for_each_primitive(repeated.open, limit, [&](const PlacedPrimitive& primitive) {
            const std::uint32_t material = materials.of(primitive, scene);
            take_class_of_material(primitive, repeated.class_name);
            builder.add(primitive, [&] { mesh.triangle_material.push_back(material); });
        });
}

}  // namespace

SurfaceExtent find_extent(const OpenFile& file, ReadingLimit& limit) {
    SurfaceExtent extent;
    for_each_primitive(file, limit, [&extent](const PlacedPrimitive& primitive) {
        Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  // in the mesh's own axes
        std::vector<Eigen::Vector3d> placed = primitive.positions;
        for (Eigen::Vector3d& point : placed)
            point = primitive.mesh.T_world_mesh * point;
        for (const auto& [a, b, c] : primitive.triangles) {
            const std::array points{placed[a], placed[b], placed[c]};
            if (!is_finite(points) || !has_area(points)) continue;
            for (const std::uint32_t vertex : {a, b, c}) {
                farthest = farthest.cwiseMax(primitive.positions[vertex].cwiseAbs());
                if (placed[vertex].cwiseAbs().maxCoeff() > furthest_m)
                    refuse(primitive.where, "a vertex lies more than 1e8 m from the origin");
                extent.box.extend(placed[vertex]);
            }
        }
        if (!primitive.has_floats) return;  // integers are exact
        const Eigen::Vector3d off =
            primitive.mesh.T_world_mesh.linear().cwiseAbs() * farthest.unaryExpr(&half_unit);
        extent.vertex_rounding_m = std::max(extent.vertex_rounding_m, off.maxCoeff());
    });
    return extent;
}

SurfaceExtent moved(const SurfaceExtent& extent, const Eigen::Affine3d& transform) {
    if (extent.box.isEmpty()) return extent;
    SurfaceExtent out;
    for (int corner = 0; corner < 8; ++corner) {
        out.box.extend(transform *
                       extent.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
    if (out.box.min().cwiseAbs().cwiseMax(out.box.max().cwiseAbs()).maxCoeff() > furthest_m)
        throw InputError("an object lies more than 1e8 m from the origin");
    out.vertex_rounding_m =
        extent.vertex_rounding_m * transform.linear().cwiseAbs().rowwise().sum().maxCoeff();
    return out;
}

Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t sharing_threshold,
                     ReadingLimit& limit) {
    constexpr std::size_t max_triangles = 0xFFFF0000U;
    std::map<decltype(settings_of(PlacedFile())), std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PlacedFile& file = *open[i].placed;
        if (!file.name.empty() && !file.moves) alike[settings_of(file)].push_back(i);
    }
    std::erase_if(alike, [](const auto& group) { return group.second.size() < 2; });
    std::size_t triangles = 0;
    for (const auto& group : alike)
        triangles += group.second.size() * triangles_of(open[group.second.front()]);
    Repeats repeats;
    repeats.by_file.assign(open.size(), nullptr);
    if (triangles <= sharing_threshold) return repeats;
    if (triangles > max_triangles) {
        refuse(open[alike.begin()->second.front()].placed->place,
               "repeated files have {} triangles together with this one; at most 4294901760 are "
               "supported",
               triangles);
    }
    for (const auto& group : alike) {
        const OpenFile& first = open[group.second.front()];
        RepeatedFile& repeated = repeats.files.emplace_back(RepeatedFile{*first.placed, first});
        repeated.placed.T_world_file = Eigen::Affine3d::Identity();
        UniqueNames names;
        repeated.open.placed = &repeated.placed;
        repeated.open.meshes = place_meshes(*first.model, repeated.placed, names);
        repeated.extent = find_extent(repeated.open, limit);
        for (const std::size_t file : group.second)
            repeats.by_file[file] = &repeated;
    }
    return repeats;
}

void add_copy(RepeatedFile& repeated, const OpenFile& file, ReadingLimit& limit,
              MaterialNumbers& materials, Scene& scene) {
    if (!repeated.mesh) add_repeated_mesh(repeated, limit, materials, scene);
    const std::uint32_t instance = file.instance_of_mesh.front();
    scene.instance_classes[instance] = repeated.class_name;
    scene.copies.push_back(
        {*repeated.mesh, instance,
         file.placed->T_world_file * Eigen::Translation3d(repeated.extent.centre())});
}

}  // namespace sonarsim
