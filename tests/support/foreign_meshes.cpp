#include "support/foreign_meshes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "scene/gltf/load.h"
#include "support/shapes.h"

namespace sonarsim::test {

std::vector<ForeignMesh> foreign_meshes(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".glb") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    std::vector<ForeignMesh> meshes;
    for (const std::filesystem::path& file : files) {
        try {
            Scene scene = load_scene_geometry(file);
            if (scene.triangles.size() < 150 || scene.triangles.size() > 300'000) continue;
            meshes.push_back({file.stem().string(), std::move(scene)});
        } catch (const InputError&) {
        }
    }
    return meshes;
}

Lattice draw_foreign_mesh(std::uint32_t number, const std::vector<ForeignMesh>& meshes) {
    Draws draws(number);
    const auto& [name, mesh] = meshes[draws.whole(0, static_cast<int>(meshes.size()) - 1)];
    Scene scene = shapes::empty_scene();
    std::vector<std::uint32_t> materials;
    for (std::size_t k = 0; k < mesh.materials.size(); ++k)
        materials.push_back(shapes::add_material(scene, draws.between(0.05F, 0.9F)));
    const Eigen::Vector3f low = (mesh.bounds_min - mesh.origin).cast<float>();
    const Eigen::Vector3f high = (mesh.bounds_max - mesh.origin).cast<float>();
    const float half = 0.5F * (high - low).maxCoeff();
    for (const Eigen::Vector3f& vertex : mesh.vertices)
        scene.vertices.push_back((vertex - 0.5F * (low + high)) / half);
    scene.triangles = mesh.triangles;
    for (const std::uint32_t material : mesh.triangle_material)
        scene.triangle_material.push_back(materials[material]);
    scene.triangle_instance.assign(scene.triangles.size(), 0);
    return place_lattice(draws, number, name, std::move(scene));
}

}  // namespace sonarsim::test
