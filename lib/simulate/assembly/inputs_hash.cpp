#include "simulate/assembly/inputs_hash.h"

#include "core/hash.h"
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
    // Vertices may lie in a file that a glTF names, which is not among the inputs.
    std::string text = hash_of(scene.vertices) + hash_of(scene.triangles);
    for (const double x : {scene.origin.x(), scene.origin.y(), scene.origin.z()})
        text += " " + number_text(x);
    for (const Body& body : scene.bodies)
        text += hash_of(body.vertices) + hash_of(body.triangles);
    for (const SharedMesh& mesh : scene.shared_meshes)
        text += hash_of(mesh.vertices) + hash_of(mesh.triangles);
    if (scene.maps) text += scene.maps->identity();
    for (const InputFile& input : assembly.inputs)
        text += "\n" + input.sha256;
    for (const Trajectory& motion : assembly.motions)
        text += "\n" + write_tum(motion);
    return fnv1a_128(text + "\n" + write_tum(assembly.trajectory));
}

}  // namespace sonarsim
