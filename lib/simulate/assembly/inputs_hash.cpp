#include "simulate/assembly/inputs_hash.h"

#include "core/hash.h"
#include "core/sha256.h"
#include "core/text.h"
#include "input/scene/maps/ground_maps.h"
#include "input/trajectory/files.h"

namespace sonarsim {

namespace {

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return sha256({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

std::string inputs_hash(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    std::string text = hash_of(scene.vertices) + hash_of(scene.triangles) +
                       hash_of(scene.triangle_material) + hash_of(scene.triangle_instance);
    for (const double x : {scene.origin.x(), scene.origin.y(), scene.origin.z()}) {
        text += " " + number_text(x);
    }
    for (const Material& material : scene.materials) {
        text += "\n" + material.name + "\n" + number_text(material.density_kg_m3) + " " +
                number_text(material.sound_speed_m_s) + " " + number_text(material.lambert_db) +
                " " + number_text(material.slope_rms_deg);
        for (const auto& [name, value] :
             {std::pair{"wall_mm", material.wall_mm},
              std::pair{"roughness_mm", material.roughness_mm},
              std::pair{"grain_phi", material.grain_phi},
              std::pair{"loss_parameter", material.loss_parameter},
              std::pair{"spectral_strength_cm4", material.spectral_strength_cm4},
              std::pair{"spectral_exponent", material.spectral_exponent},
              std::pair{"volume_parameter", material.volume_parameter}}) {
            if (value) text += std::string(" ") + name + " " + number_text(*value);
        }
    }
    for (const std::string& instance : scene.instances)
        text += "\n" + instance;
    for (std::size_t i = 0; i < scene.instance_classes.size(); ++i) {
        if (scene.instance_classes[i].empty()) continue;
        text += "\nclass " + std::to_string(i) + " " + scene.instance_classes[i];
    }
    for (const Body& body : scene.bodies) {
        text += "\nbody " + std::to_string(body.instance) + hash_of(body.vertices) +
                hash_of(body.triangles) + hash_of(body.triangle_material);
    }
    for (const SharedMesh& mesh : scene.shared_meshes) {
        text += "\nmesh " + hash_of(mesh.vertices) + hash_of(mesh.triangles) +
                hash_of(mesh.triangle_material);
    }
    for (const MeshCopy& copy : scene.copies) {
        text += "\ncopy " + std::to_string(copy.mesh) + " " + std::to_string(copy.instance);
        for (const double x : copy.T_world_mesh.matrix().topRows<3>().reshaped())
            text += " " + number_text(x);
    }
    if (scene.maps) text += scene.maps->identity();
    for (const Sonar& sonar : assembly.sonars) {
        if (const auto& profile = sonar.sound_profile)
            text += "\nprofile " + hash_of(profile->height_m) + hash_of(profile->speed_m_s);
    }
    for (const Trajectory& motion : assembly.motions)
        text += "\n" + write_tum(motion);
    return fnv1a_128(text + "\n" + write_tum(assembly.trajectory));
}

}  // namespace sonarsim
