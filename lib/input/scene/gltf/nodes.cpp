#include "input/scene/gltf/nodes.h"

#include <array>
#include <cmath>

#include "core/text.h"
#include "input/scene/objects.h"

namespace sonarsim {

namespace {

void check_parts(const auto& parts, const std::string& list, const Location& where) {
    // Children inherit it, so that a long text would be stored many times.
    constexpr std::size_t max_bytes = 1000;
    const std::array<std::string, 2> known{"material", "class"};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const tinygltf::Value& extras = parts[i].extras;
        if (!extras.IsObject() || !extras.Has("sonar")) continue;
        const std::string path = list + "[" + std::to_string(i) + "].extras.sonar";
        const tinygltf::Value& sonar = extras.Get("sonar");
        if (!sonar.IsObject()) refuse(where, "{} is not an object", path);
        for (const std::string& key : sonar.Keys()) {
            if (!contains(known, key)) {
                refuse(where, "{}: unknown key '{}'{}; only 'material' and 'class' are read", path,
                       printable(key), did_you_mean(key, known));
            }
            const tinygltf::Value& value = sonar.Get(key);
            if (value.IsString() && value.Get<std::string>().size() <= max_bytes) continue;
            refuse(where, "{}.{} is not a text of at most 1000 bytes", path, key);
        }
    }
}

constexpr int deepest_node = 256;
constexpr int no_parent = -1;

struct Graph {
    const tinygltf::Model& model;
    const std::string& file;

    std::size_t size() const { return model.nodes.size(); }
    const tinygltf::Node& node(int index) const {
        return model.nodes[static_cast<std::size_t>(index)];
    }
    std::string name(int index) const {
        return node(index).name.empty() ? "node" + std::to_string(index) : node(index).name;
    }
    template <class... Parts>
    [[noreturn]] void fail(int index, fmt::format_string<Parts...> what, Parts&&... parts) const {
        refuse({file}, "node '{}' {}", name(index),
               fmt::format(what, std::forward<Parts>(parts)...));
    }
    void check_exists(int index, const std::string& what) const {
        if (static_cast<std::size_t>(index) < size()) return;
        refuse({file}, "{} node {}, which does not exist", what, index);
    }
};

std::vector<int> parents_of(const Graph& graph) {
    std::vector<int> parent(graph.size(), no_parent);
    for (int i = 0; i < static_cast<int>(graph.size()); ++i) {
        for (const int child : graph.node(i).children) {
            graph.check_exists(child, "node '" + graph.name(i) + "' has the child");
            int& known = parent[static_cast<std::size_t>(child)];
            if (known != no_parent) {
                graph.fail(child, "has two parents, '{}' and '{}'", graph.name(known),
                           graph.name(i));
            }
            known = i;
        }
    }
    // Refuse nodes below a cycle and nodes that lie too deep.
    for (int i = 0; i < static_cast<int>(graph.size()); ++i) {
        int above = i;
        for (int depth = 1; above != no_parent; ++depth) {
            if (depth > deepest_node) graph.fail(i, "lies deeper than 256 levels in the hierarchy");
            above = parent[static_cast<std::size_t>(above)];
            if (above == i) graph.fail(i, "is its own ancestor");
        }
    }
    return parent;
}

std::vector<int> scene_roots(const Graph& graph, const std::vector<int>& parent) {
    const tinygltf::Model& model = graph.model;
    std::vector<int> roots;
    if (model.scenes.empty() && model.defaultScene < 0) {
        for (int i = 0; i < static_cast<int>(graph.size()); ++i) {
            if (parent[static_cast<std::size_t>(i)] == no_parent) roots.push_back(i);
        }
        return roots;
    }
    const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) {
        refuse({graph.file}, "the default scene is {}, which does not exist", scene);
    }
    std::vector<bool> is_listed(graph.size(), false);
    for (const int root : model.scenes[scene].nodes) {
        graph.check_exists(root, "the scene has the root");
        const auto i = static_cast<std::size_t>(root);
        if (parent[i] != no_parent) {
            graph.fail(root, "is a root of the scene, but also a child of '{}'",
                       graph.name(parent[i]));
        }
        if (is_listed[i]) graph.fail(root, "is listed twice in the scene");
        is_listed[i] = true;
        roots.push_back(root);
    }
    return roots;
}

Eigen::Affine3d local_transform(const Graph& graph, int index) {
    const tinygltf::Node& node = graph.node(index);
    const auto require_size = [&](const char* key, const std::vector<double>& numbers,
                                  std::size_t size) {
        if (numbers.empty() || numbers.size() == size) return;
        graph.fail(index, "has a {} of {} numbers; expected {}", key, numbers.size(), size);
    };
    require_size("matrix", node.matrix, 16);
    require_size("translation", node.translation, 3);
    require_size("rotation", node.rotation, 4);
    require_size("scale", node.scale, 3);
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (!node.matrix.empty()) {
        transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
        if (transform.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
            graph.fail(index, "has a matrix whose last row is not 0 0 0 1");
        }
        return transform;
    }
    if (!node.translation.empty()) {
        transform.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    }
    if (!node.rotation.empty()) {
        constexpr double tolerance = 1e-3;  // exporters round the components
        const auto& q = node.rotation;
        const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
        if (!(std::abs(rotation.norm() - 1.0) <= tolerance)) {
            graph.fail(index, "has a rotation that is not a unit quaternion");
        }
        transform.rotate(rotation.normalized());
    }
    if (!node.scale.empty()) {
        transform.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
    }
    return transform;
}

void check_rigid(const Graph& graph, int index) {
    const tinygltf::Node& node = graph.node(index);
    const auto& meshes = graph.model.meshes;
    if (static_cast<std::size_t>(node.mesh) >= meshes.size()) {
        graph.fail(index, "has mesh {}, which does not exist", node.mesh);
    }
    if (node.skin >= 0) {
        graph.fail(index, "is skinned, which is not read; apply the armature before the export");
    }
    const auto& mesh = meshes[static_cast<std::size_t>(node.mesh)];
    const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
    if (std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; })) {
        graph.fail(index, "is morphed, which is not read; apply the shape keys before the export");
    }
}

/// Adds a mesh, without the materials that are instances of their own, and these after it.
void add_parts(const PlacedMesh& whole, const PlacedFile& file, const tinygltf::Model& model,
               UniqueNames& names, std::vector<PlacedMesh>& placed) {
    PlacedMesh rest = whole;
    std::map<int, std::string> parts;
    for (const auto& primitive : model.meshes[static_cast<std::size_t>(whole.mesh)].primitives) {
        const auto index = static_cast<std::size_t>(primitive.material);
        const std::string name =
            index < model.materials.size() ? model.materials[index].name : std::string();
        if (!name.empty() && fits_any(file.parts, name))
            parts.emplace(primitive.material, name);
        else
            rest.materials.insert(primitive.material);
    }
    if (parts.empty() || !whole.material.empty()) return placed.push_back(whole);
    if (!rest.materials.empty()) placed.push_back(rest);
    for (const auto& [material, name] : parts) {
        PlacedMesh& part = placed.emplace_back(whole);
        part.instance = names.unique(whole.node + "." + name);
        part.own_name = whole.own_name + "." + name;
        part.materials = {material};
    }
}

/// The transform from the file's axes and unit to metres with z up.
Eigen::Affine3d file_from_gltf(const PlacedFile& placed) {
    Eigen::Affine3d T_file_gltf = Eigen::Affine3d::Identity();
    if (!placed.z_up) T_file_gltf.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    T_file_gltf.linear() *= placed.unit_m;
    return T_file_gltf;
}

/// Adds the meshes of a node and of those below it, which inherit what is `above`.
void place_node(const Graph& graph, int index, const PlacedMesh& above, const PlacedFile& file,
                UniqueNames& names, std::vector<PlacedMesh>& placed) {
    const tinygltf::Node& node = graph.node(index);
    PlacedMesh own = above;
    own.T_world_mesh = above.T_world_mesh * local_transform(graph, index);
    const std::string material = sonar_extra(node.extras, "material");
    if (!material.empty()) own.material = material;
    const std::string label = sonar_extra(node.extras, "class");
    if (!label.empty()) own.label = label;
    if (node.mesh >= 0) {
        check_rigid(graph, index);
        own.mesh = node.mesh;
        own.own_name = own.own_node = file.name.empty() ? graph.name(index) : file.name;
        own.node = file.name.empty() ? names.unique(own.own_name) : file.name;
        own.instance = own.node;
        add_parts(own, file, graph.model, names, placed);
    }
    for (const int child : node.children)
        place_node(graph, child, own, file, names, placed);
}

}  // namespace

std::string sonar_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.IsObject() || !extras.Has("sonar")) return "";
    const tinygltf::Value& sonar = extras.Get("sonar");
    return sonar.IsObject() && sonar.Has(key) ? sonar.Get(key).Get<std::string>() : "";
}

void check_extras(const tinygltf::Model& model, const Location& where) {
    check_parts(model.nodes, "nodes", where);
    check_parts(model.materials, "materials", where);
}

std::string UniqueNames::unique(const std::string& name) {
    std::string candidate = name;
    while (!taken.insert(candidate).second) {
        int& number = last.emplace(name, 1).first->second;
        candidate = name + "_" + std::to_string(++number);
    }
    return candidate;
}

std::vector<PlacedMesh> place_meshes(const tinygltf::Model& model, const PlacedFile& file,
                                     UniqueNames& names) {
    const std::string path = file.file.string();
    const Graph graph{model, path};
    const std::vector<int> parent = parents_of(graph);
    PlacedMesh world;
    world.T_world_mesh = file.T_world_file * file_from_gltf(file);
    std::vector<PlacedMesh> placed;
    for (const int root : scene_roots(graph, parent))
        place_node(graph, root, world, file, names, placed);
    return placed;
}

}  // namespace sonarsim
