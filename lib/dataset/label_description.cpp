#include "dataset/label_description.h"

#include "dataset/annotated_objects.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Json box_json(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return nullptr;
    return {{"min", vector_json(box.min())}, {"max", vector_json(box.max())}};
}

}  // namespace

std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly) {
    std::vector<Eigen::AlignedBox3d> boxes = still_boxes(assembly);
    for (const Body& body : assembly.scene.bodies)
        boxes[assembly.objects.object_of(body.instance)].setEmpty();
    return boxes;
}

std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    std::vector<int> parts(objects.objects.size(), 0);
    for (const std::uint32_t object : objects.object_of_instance)
        ++parts[object];
    std::vector<std::optional<MovingObject>> moving(parts.size());
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const std::uint32_t object = objects.object_of(scene.bodies[k].instance);
        if (parts[object] > 1) continue;
        MovingObject& own = moving[object].emplace(MovingObject{k, {}});
        for (const Eigen::Vector3f& vertex : scene.bodies[k].vertices)
            own.box.extend(vertex.cast<double>());
    }
    return moving;
}

Json describe_label_ids(const Assembly& assembly) {
    const SceneObjects& objects = assembly.objects;
    const std::vector<Eigen::AlignedBox3d> boxes = object_boxes(assembly);
    Json json = {{"none", 0}};
    json["instances"] = Json::array();
    for (std::size_t k = 0; k < objects.objects.size(); ++k) {
        const SceneObjects::Object& object = objects.objects[k];
        json["instances"].push_back({{"id", k + 1},
                                     {"name", object.name},
                                     {"class", object.class_index + 1},
                                     {"box_world_m", box_json(boxes[k])}});
    }
    json["classes"] = Json::array();
    for (std::size_t k = 0; k < objects.classes.size(); ++k) {
        json["classes"].push_back({{"id", k + 1}, {"name", objects.classes[k]}});
    }
    json["materials"] = Json::array();
    for (std::size_t k = 0; k < assembly.scene.materials.size(); ++k) {
        json["materials"].push_back({{"id", k + 1}, {"name", assembly.scene.materials[k].name}});
    }
    return json;
}

Json describe_annotations(const SceneObjects& objects) {
    Json background = Json::array();
    for (std::size_t k = 0; k < objects.background.size(); ++k) {
        if (objects.background[k] != 0) background.push_back(objects.classes[k]);
    }
    return {{"background", std::move(background)}};
}

}  // namespace sonarsim
