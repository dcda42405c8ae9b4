#include "trace/find_coherent_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/groups.h"
#include "scene/maps/ground_maps.h"
#include "trace/mesh_faces.h"

namespace sonarsim {

namespace {

/// The plates of a mesh. `mapped`: maps lie on it.
void add_faces(const FaceMesh& mesh, std::uint32_t instance, bool mapped, CoherentFaces& out) {
    for (MeshFace& face : faces_of(mesh)) {
        out.plates.push_back({.triangles = std::move(face.triangles),
                              .border = std::move(face.border),
                              .normal = face.normal,
                              .material = face.material,
                              .instance = instance,
                              .mapped = mapped});
    }
}

/// The materials of a scene that reflect coherently, and the instances on which maps may lay them.
class CoherentMaterials {
  public:
    explicit CoherentMaterials(const Scene& scene) : maps_(scene.maps.get()) {
        for (const Material& material : scene.materials)
            coherent_.push_back(material.roughness_m ? 1 : 0);
        in_texels_ = maps_ && std::ranges::any_of(maps_->materials(), [&](std::uint32_t m) {
                         return coherent_[m] != 0;
                     });
    }

    bool any() const { return std::ranges::find(coherent_, 1) != coherent_.end(); }
    bool is_mapped(std::uint32_t instance) const { return maps_ && maps_->lie_on(instance); }
    /// True if a surface may reflect coherently by its own material or by its maps.
    bool may_reflect(std::uint32_t material, bool mapped) const {
        return coherent_[material] != 0 || (mapped && in_texels_);
    }

  private:
    const GroundMaps* maps_;
    std::vector<char> coherent_;
    bool in_texels_ = false;
};

/// Moves the faces of a mesh to the place of a copy.
class Placement {
  public:
    Placement(const Eigen::Affine3d& T_world_mesh, const Eigen::Vector3d& origin)
        : T_local_mesh_(T_world_mesh) {
        T_local_mesh_.translation() -= origin;
    }

    void place(Eigen::Vector3f& point) const {
        point = (T_local_mesh_ * point.cast<double>()).cast<float>();
    }
    void turn(Eigen::Vector3f& normal) const {
        normal = (T_local_mesh_.linear() * normal.cast<double>()).normalized().cast<float>();
    }
    void place(ScenePlate& plate) const {
        for (auto& triangle : plate.triangles) {
            for (Eigen::Vector3f& corner : triangle)
                place(corner);
        }
        for (auto& side : plate.border) {
            for (Eigen::Vector3f& end : side)
                place(end);
        }
        turn(plate.normal);
    }

  private:
    Eigen::Affine3d T_local_mesh_;
};

void add_own_faces(const Scene& scene, const CoherentMaterials& materials, CoherentFaces& out) {
    const Groups groups = sort_into_groups(scene.triangle_instance, scene.instances.size());
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const bool mapped = materials.is_mapped(instance);
        FaceMesh triangles;
        for (std::uint32_t k = groups.begin[instance]; k < groups.begin[instance + 1]; ++k) {
            const std::uint32_t t = groups.items[k];
            if (materials.may_reflect(scene.triangle_material[t], mapped))
                triangles.add(scene.vertices, scene.triangles[t], scene.triangle_material[t]);
        }
        add_faces(triangles, instance, mapped, out);
    }
}

void add_copied_faces(const Scene& scene, const CoherentMaterials& materials, CoherentFaces& out) {
    std::map<std::pair<std::uint32_t, bool>, CoherentFaces> of_mesh;  // without and with maps
    for (const MeshCopy& copy : scene.copies) {
        const bool mapped = materials.is_mapped(copy.instance);
        const auto [place, is_new] = of_mesh.try_emplace({copy.mesh, mapped});
        if (is_new) {
            const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
            FaceMesh triangles;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                if (materials.may_reflect(mesh.triangle_material[t], mapped))
                    triangles.add(mesh.vertices, mesh.triangles[t], mesh.triangle_material[t]);
            }
            add_faces(triangles, 0, mapped, place->second);
        }
        const Placement placement(copy.T_world_mesh, scene.origin);
        for (const ScenePlate& plate : place->second.plates) {
            out.plates.push_back(plate);
            placement.place(out.plates.back());
            out.plates.back().instance = copy.instance;
        }
    }
}

}  // namespace

std::shared_ptr<const CoherentFaces> find_coherent_faces(const Scene& scene) {
    const CoherentMaterials materials(scene);
    if (!materials.any()) return nullptr;
    auto out = std::make_shared<CoherentFaces>();
    add_own_faces(scene, materials, *out);
    add_copied_faces(scene, materials, *out);
    return out;
}

}  // namespace sonarsim
