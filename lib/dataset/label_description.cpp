#include "dataset/label_description.h"

#include <algorithm>
#include <array>

#include "dataset/annotated_objects.h"
#include "format/id_png.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

template <class T, std::size_t N>
std::string name_of(T value, const std::array<Choice<T>, N>& choices) {
    return std::ranges::find(choices, value, &Choice<T>::value)->name;
}

template <class T, std::size_t N>
T value_of(const CheckedJson& json, const std::array<Choice<T>, N>& choices) {
    std::string all;
    for (const Choice<T>& one : choices) {
        if (json.text() == one.name) return one.value;
        all += (all.empty() ? "" : ", ") + std::string(one.name);
    }
    json.refuse("one of " + all);
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
        const Rgb colour = colour_of(static_cast<std::uint32_t>(k + 1));
        json["classes"].push_back({{"id", k + 1},
                                   {"name", objects.classes[k]},
                                   {"colour", {colour.r, colour.g, colour.b}}});
    }
    json["materials"] = Json::array();
    for (std::size_t k = 0; k < assembly.scene.materials.size(); ++k) {
        json["materials"].push_back({{"id", k + 1}, {"name", assembly.scene.materials[k].name}});
    }
    return json;
}

Json describe_annotations(const LabelConfig& config, const SceneObjects& objects) {
    Json background = Json::array();
    for (std::size_t k = 0; k < objects.background.size(); ++k) {
        if (objects.background[k] != 0) background.push_back(objects.classes[k]);
    }
    return {{"background", std::move(background)},
            {"min_pixels", static_cast<std::uint64_t>(config.min_pixels)},
            {"min_visible_share", config.min_visible_share},
            {"min_contrast_db", config.min_contrast_db},
            {"faint", name_of(config.faint, faint_objects)},
            {"box", name_of(config.box, label_boxes)}};
}

AnnotationRules annotation_rules(const CheckedJson& labels) {
    AnnotationRules rules;
    const std::vector<CheckedJson> classes = labels.at("classes").items();
    rules.background.assign(classes.size(), 0);
    const std::optional<CheckedJson> annotations = labels.find("annotations");
    if (!annotations) return rules;
    for (const CheckedJson& name : annotations->at("background").items()) {
        const auto found = std::ranges::find_if(
            classes, [&](const CheckedJson& one) { return one.at("name").text() == name.text(); });
        if (found == classes.end()) name.refuse("the name of a class");
        rules.background[static_cast<std::size_t>(found - classes.begin())] = 1;
    }
    constexpr std::uint64_t most_pixels = 1'000'000'000;
    rules.config.min_pixels = static_cast<int>(annotations->at("min_pixels").whole(1, most_pixels));
    rules.config.min_visible_share = annotations->at("min_visible_share").number();
    rules.config.min_contrast_db = annotations->at("min_contrast_db").number();
    rules.config.faint = value_of(annotations->at("faint"), faint_objects);
    rules.config.box = value_of(annotations->at("box"), label_boxes);
    return rules;
}

}  // namespace sonarsim
