#include "input/scene/gltf/primitives.h"

#include "core/text.h"
#include "input/scene/meshes/read_mesh.h"

namespace sonarsim {

namespace {

/// The primitive's material in the file; null if it has none or one that does not exist.
const tinygltf::Material* material_of(const PlacedPrimitive& primitive) {
    const auto& materials = primitive.file.model->materials;
    const auto index = static_cast<std::size_t>(primitive.material);
    return index < materials.size() ? &materials[index] : nullptr;
}

/// The name of a primitive's material in the file; "" if it has none.
std::string name_in_file(const PlacedPrimitive& primitive) {
    if (!primitive.mesh.material.empty()) return primitive.mesh.material;
    if (primitive.material < 0) return "";
    const tinygltf::Material* const material = material_of(primitive);
    if (!material) refuse(primitive.where, "material {} does not exist", primitive.material);
    const std::string own = sonar_extra(material->extras, "material");
    return own.empty() ? material->name : own;
}

/// The name of a primitive's material in the CSV. InputError if it has none.
std::string material_name(const PlacedPrimitive& primitive, const MaterialNumbers& materials) {
    const PlacedFile& placed = *primitive.file.placed;
    if (!placed.material.empty()) return placed.material;
    std::string name = name_in_file(primitive);
    if (!materials.known.contains(name) && materials.known.contains(without_copy_number(name)))
        name = without_copy_number(name);
    if (!materials.fallback.empty() && !materials.known.contains(name)) return materials.fallback;
    if (!name.empty()) return name;
    if (materials.nameless_allowed) return "(no material)";
    if (placed.heightmap || placed.seabed) {
        refuse(placed.place, "the {0} has no material; write scene.{0}.material: NAME",
               placed.seabed ? "seabed" : "heightmap");
    }
    if (is_mesh_file(placed.file)) {
        refuse(placed.place,
               "'{}' has no material in {}; write material: NAME for an object, or "
               "scene.material_default for all that have none",
               printable(primitive.mesh.instance), placed.file.string());
    }
    refuse(primitive.in_node(),
           "{}; name one in the glTF material or as extras.sonar.material of the node, or give "
           "scene.material_default",
           primitive.material < 0 ? "has no material" : "its material has no name");
}

/// "'NODE' in FILE (mission.yaml:6:7)": the primitive's node, for messages.
std::string user_of(const PlacedPrimitive& primitive) {
    const PlacedFile& file = *primitive.file.placed;
    return "'" + printable(primitive.mesh.instance) + "' in " + file.file.string() +
           (file.place.file.empty() ? "" : " (" + file.place.text() + ")");
}

}  // namespace

std::uint32_t MaterialNumbers::of(const PlacedPrimitive& primitive, Scene& scene) {
    const std::string name = material_name(primitive, *this);
    const auto number = static_cast<std::uint32_t>(scene.materials.size());
    const auto [entry, is_new] = numbers.emplace(name, number);
    if (is_new) {
        scene.materials.emplace_back().name = name;
        users.push_back(user_of(primitive));
    }
    return entry->second;
}

void take_class_of_material(const PlacedPrimitive& primitive, std::string& class_name) {
    if (!primitive.file.placed->class_name.empty()) return;
    const tinygltf::Material* const material = material_of(primitive);
    if (!primitive.mesh.label.empty() || !material) return;
    const std::string own = sonar_extra(material->extras, "class");
    if (own.empty() || own == class_name) return;
    if (!class_name.empty()) {
        refuse(primitive.in_node(),
               "its material has the class '{}', another of the node's '{}'; give the node a class "
               "as its extras.sonar.class",
               own, class_name);
    }
    class_name = own;
}

}  // namespace sonarsim
