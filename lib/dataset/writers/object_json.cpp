#include "dataset/writers/object_json.h"

#include "dataset/ping_metadata.h"
#include "product/object_table.h"

namespace sonarsim {

namespace {

nlohmann::ordered_json or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json corner_json(const Eigen::Vector3f& v) {
    return {v.x(), v.y(), v.z()};
}

nlohmann::ordered_json seen_json(const SeenObject& seen, const SceneObjects& objects) {
    const SceneObjects::Object& object = objects.objects[seen.id - 1];
    nlohmann::ordered_json json = {{"id", seen.id},
                                   {"name", object.name},
                                   {"class", objects.classes[object.class_index]},
                                   {"box_bins",
                                    {{"range", {seen.range_first, seen.range_last + 1}},
                                     {"beam", {seen.beam_first, seen.beam_last + 1}}}},
                                   {"area_bins", seen.bins},
                                   {"level", seen.level},
                                   {"level_around", or_null(seen.surrounding_level)},
                                   {"range_m", seen.range_m},
                                   {"azimuth_rad", or_null(seen.azimuth_rad)},
                                   {"seen_box_sensor_m", nullptr}};
    if (!seen.box_sensor_m.isEmpty()) {
        json["seen_box_sensor_m"] = {{"min", corner_json(seen.box_sensor_m.min())},
                                     {"max", corner_json(seen.box_sensor_m.max())}};
    }
    return json;
}

}  // namespace

std::string object_json(const WriterContext& context, const FinishedPing& finished) {
    const SceneObjects& objects = context.assembly.objects;
    nlohmann::ordered_json json = {{"ping", finished.id.pose}};
    json["objects"] = nlohmann::ordered_json::array();
    for (const SeenObject& seen :
         seen_objects(context.sonar(), objects, finished.traced, *finished.labels, finished.ping)) {
        json["objects"].push_back(seen_json(seen, objects));
    }
    return json_text(json);
}

}  // namespace sonarsim
