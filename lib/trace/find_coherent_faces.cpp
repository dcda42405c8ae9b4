#include "trace/find_coherent_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/groups.h"
#include "scene/maps/ground_maps.h"
#include "trace/corners.h"
#include "trace/strips.h"

namespace sonarsim {

namespace {

/// The plates and strips of a mesh.
void add_faces(const FaceMesh& mesh, std::uint32_t instance, CoherentFaces& out) {
    for (MeshFace& face : faces_of(mesh)) {
        if (face.smooth.empty()) {
            out.plates.push_back({.triangles = std::move(face.triangles),
                                  .border = std::move(face.border),
                                  .normal = face.normal,
                                  .material = face.material,
                                  .instance = instance});
        } else if (auto strip = strip_of(face)) {
            strip->instance = instance;
            out.strips.push_back(*strip);
        }
    }
}

/// Adds the plates and strips of an instance with maps, whatever its own materials are. Its corners
/// are left out.
void add_mapped_faces(const FaceMesh& mesh, std::uint32_t instance, CoherentFaces& out) {
    CoherentFaces found;
    add_faces(mesh, instance, found);
    for (ScenePlate& plate : found.plates) {
        plate.mapped = true;
        out.plates.push_back(std::move(plate));
    }
    for (SceneStrip& strip : found.strips) {
        strip.mapped = true;
        out.strips.push_back(strip);
    }
}

/// A mesh at the place of a copy.
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
    void place(SceneStrip& strip) const {
        for (Ruling* const ruling : {&strip.first, &strip.second}) {
            place(ruling->from);
            place(ruling->to);
            turn(ruling->normal);
        }
        turn(strip.normal);
    }

  private:
    Eigen::Affine3d T_local_mesh_;
};

void add_copied_faces(const Scene& scene, const std::vector<char>& coherent, CoherentFaces& out) {
    std::map<std::uint32_t, CoherentFaces> of_mesh;
    for (const MeshCopy& copy : scene.copies) {
        if (scene.maps && scene.maps->lie_on(copy.instance)) continue;
        const auto [place, is_new] = of_mesh.try_emplace(copy.mesh);
        if (is_new) {
            const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
            FaceMesh triangles;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                if (coherent[mesh.triangle_material[t]] != 0)
                    triangles.add(mesh.vertices, mesh.triangles[t], mesh.triangle_material[t]);
            }
            add_faces(triangles, 0, place->second);
        }
        const Placement placement(copy.T_world_mesh, scene.origin);
        const auto add_to = [&](const auto& from, auto& to) {
            for (const auto& face : from) {
                to.push_back(face);
                placement.place(to.back());
                to.back().instance = copy.instance;
            }
        };
        add_to(place->second.plates, out.plates);
        add_to(place->second.strips, out.strips);
    }
}

}  // namespace

std::shared_ptr<const CoherentFaces> find_coherent_faces(const Scene& scene) {
    std::vector<char> coherent;
    for (const Material& material : scene.materials)
        coherent.push_back(material.roughness_m ? 1 : 0);
    if (std::ranges::find(coherent, 1) == coherent.end()) return nullptr;
    auto out = std::make_shared<CoherentFaces>();
    const Groups groups = sort_into_groups(scene.triangle_instance, scene.instances.size());
    const auto mesh_of = [&](std::uint32_t instance, bool all) {
        FaceMesh triangles;
        for (std::uint32_t k = groups.begin[instance]; k < groups.begin[instance + 1]; ++k) {
            const std::uint32_t t = groups.items[k];
            if (all || coherent[scene.triangle_material[t]] != 0)
                triangles.add(scene.vertices, scene.triangles[t], scene.triangle_material[t]);
        }
        return triangles;
    };
    const auto is_mapped = [&](std::uint32_t instance) {
        return scene.maps && scene.maps->lie_on(instance);
    };
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        if (!is_mapped(instance)) add_faces(mesh_of(instance, false), instance, *out);
    }
    add_copied_faces(scene, coherent, *out);
    find_corners(*out);
    const bool in_texels =
        scene.maps && std::ranges::any_of(scene.maps->materials(),
                                          [&](std::uint32_t m) { return coherent[m] != 0; });
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        if (is_mapped(instance)) add_mapped_faces(mesh_of(instance, in_texels), instance, *out);
    }
    return out;
}

}  // namespace sonarsim
