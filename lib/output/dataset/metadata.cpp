#include "output/dataset/metadata.h"

#include "core/build_info.h"
#include "core/hash.h"
#include "core/text.h"
#include "input/mission/files.h"
#include "input/mission/resolved.h"
#include "input/scene/maps/ground_maps.h"
#include "input/trajectory/trajectory.h"
#include "output/dataset/labelled_ping.h"
#include "output/format/png.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

/// The name of an input in mission.resolved.yaml.
std::string portable_name(const Mission& mission, const InputFile& input) {
    return input.path.lexically_proximate(home_of(mission)).string();
}

/// The rendered part of the scene's files, its accuracy, and the number of parts left out.
Json describe_scene_use(const Scene& scene) {
    Json json = {{"triangles", scene.triangles.size()},
                 {"vertex_rounding_m", scene.vertex_rounding_m},
                 {"dropped",
                  {{"degenerate_triangles", scene.rejects.degenerate_triangles},
                   {"non_finite_triangles", scene.rejects.non_finite_triangles},
                   {"skipped_primitives", scene.rejects.skipped_primitives}}}};
    if (!scene.copies.empty()) {
        json["shared_meshes"] = scene.shared_meshes.size();
        json["copies"] = scene.copies.size();
    }
    return json;
}

/// Describes the picture of a file of a ping, for people; null for other files.
Json describe_picture(const PingFile& file, const Json& pattern) {
    if (file.title.empty() || pattern.is_null()) return nullptr;
    Json json = {{"title", file.title}, {"file", pattern}, {"per", "ping"}};
    if (file.array == PingArray::bins) json["ahead"] = "down";
    if (file.array != PingArray::none)
        json["boxes_of"] = file.array == PingArray::fan ? "fan" : "bins";
    return json;
}

/// Describes a file of every ping: its place, its rows and columns, and the picture it may be.
void describe_ping_file(const PingFile& file, const SensorLayout& own, const std::string& number,
                        Json& json) {
    json["files"][file.name] = own.name + "/" + file.name + "/" + number + file.extension;
    if (file.array == PingArray::none) return;
    const bool is_fan = file.array == PingArray::fan;
    Json& array = json["arrays"][file.name];
    array["axes"] = is_fan ? Json{"row", "column"} : Json{"range", "azimuth"};
    if (!file.ids.empty()) array["ids"] = file.ids;
}

/// The names of the ids of labels, world boxes (m) of still instances, and background classes.
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
                                     {"box_world_m", describe_box(boxes[k])}});
    }
    json["classes"] = Json::array();
    Json background = Json::array();
    for (std::size_t k = 0; k < objects.classes.size(); ++k) {
        json["classes"].push_back({{"id", k + 1}, {"name", objects.classes[k]}});
        if (!objects.background.empty() && objects.background[k] != 0)
            background.push_back(objects.classes[k]);
    }
    json["materials"] = Json::array();
    for (std::size_t k = 0; k < assembly.scene.materials.size(); ++k)
        json["materials"].push_back({{"id", k + 1}, {"name", assembly.scene.materials[k].name}});
    json["annotations"]["background"] = std::move(background);
    return json;
}

Json describe_sensor(const Sonar& sonar, double full_scale, const Layout& layout,
                     const SensorLayout& own) {
    const SonarConfig& config = sonar.config;
    Json json = {{"name", config.name},
                 {"kind", name_of(config.kind)},
                 {"settings", "mission.resolved.yaml#/sensors/" + config.name},
                 {"stream", sonar.settings.stream},
                 {"every", config.every},
                 {"pings", own.pings},
                 {"T_vehicle_sensor", describe_pose(sonar.T_vehicle_sensor)},
                 {"full_scale", full_scale}};
    sonar.settings.model->describe(json);
    json["files"] = Json::object();
    const std::string number = "%0" + std::to_string(layout.digits) + "d";
    Json fans = Json::array();  // first among the pictures, since operators expect them
    Json pictures = Json::array();
    for (const Writer& writer : own.writers) {
        if (const auto* file = std::get_if<PingFile>(&writer.per_ping)) {
            describe_ping_file(*file, own, number, json);
            Json picture = describe_picture(*file, json["files"].value(file->name, Json()));
            if (!picture.is_null())
                (file->array == PingArray::fan ? fans : pictures).push_back(std::move(picture));
        } else {
            const auto& record = std::get<PingRecord>(writer.per_ping);
            Json& described =
                record.label.empty() ? json["records"] : json["label_records"][record.label];
            described = {{"file", config.name + "/" + record.file}, {"axes", record.axes}};
            if (record.label.empty()) described["name"] = kind_of(config.kind).record.name;
            if (!record.ids.empty()) described["ids"] = record.ids;
        }
    }
    fans.insert(fans.end(), pictures.begin(), pictures.end());
    json["pictures"] = std::move(fans);
    for (const Writer& writer : own.writers) {
        for (const std::string& name : writer.products)
            json["products"].push_back(config.name + "/" + name);
    }
    for (const Writer& writer : own.writers) {
        if (writer.describe) writer.describe(json);
    }
    json["range_edges_m"] = sonar.range_edges_m;
    if (!sonar.azimuth_edges_rad.empty()) json["azimuth_edges_rad"] = sonar.azimuth_edges_rad;
    return json;
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return sha256({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

Json describe_dataset(const Mission& mission, const Assembly& assembly, const Layout& layout) {
    Json json = {{"format", dataset_format},
                 {"format_version", dataset_format_version},
                 {"program_version", build_info().version},
                 {"build", describe_build()},
                 {"complete", false},
                 {"mission", mission.name},
                 {"mission_hash", mission_hash(mission, sonar_keys())},
                 {"inputs_hash", inputs_hash(assembly)},
                 {"inputs", Json::array()},
                 {"seed", mission.seed},
                 {"poses", assembly.trajectory.size()}};
    for (const InputFile& input : assembly.inputs) {
        json["inputs"].push_back(
            {{"file", portable_name(mission, input)}, {"sha256", input.sha256}});
    }
    describe_variant(mission, json);
    json["scene"] = describe_scene_use(assembly.scene);
    if (!mission.output.labels.empty()) json["labels"] = describe_label_ids(assembly);
    json["sensors"] = Json::array();
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        json["sensors"].push_back(describe_sensor(assembly.sonars[i], assembly.full_scales[i],
                                                  layout, layout.sensors[i]));
    }
    if (!layout.products.empty()) json["products"] = layout.products;
    return json;
}

Json describe_build() {
    const BuildInfo build = build_info();
    return {{"compiler", build.compiler},
            {"flags", build.flags},
            {"arithmetic", build.arithmetic},
            {"png_encoder", png_encoder}};
}

std::string resolved_text(const Mission& mission, const Assembly& assembly) {
    std::string text =
        "# Every key of the mission. Paths start at the folder of the scene file, FOLDER,\n"
        "# or of the materials where there is no scene file:\n"
        "#     sonarsim render mission.resolved.yaml --paths-from FOLDER\n"
        "# SHA-256 of what was read:\n";
    for (const InputFile& input : assembly.inputs)
        text += "#     " + input.sha256 + "  " + portable_name(mission, input) + '\n';
    return text + resolved_yaml(portable(mission), sonar_keys());
}

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
