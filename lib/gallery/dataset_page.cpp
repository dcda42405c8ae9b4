#include "gallery/dataset_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/error.h"
#include "core/pose.h"
#include "core/units.h"
#include "gallery/boxes.h"
#include "gallery/label_statistics.h"
#include "gallery/numbers.h"
#include "gallery/ping_tables.h"
#include "gallery/unpack.h"
#include "gallery/views.h"
#include "mission/dataset_names.h"
#include "mission/parse.h"
#include "sonar/kinds.h"
#include "sonar/sonar.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The differences of numbers in whole units: a few characters each.
class Differences {
  public:
    explicit Differences(double unit) : unit_(unit) {}

    void add(double value) {
        const std::int64_t whole = std::llround(value / unit_);
        json_.push_back(whole - last_);
        last_ = whole;
    }
    Json json() && { return std::move(json_); }

  private:
    double unit_;
    std::int64_t last_ = 0;
    Json json_ = Json::array();
};

/// Times in ms, positions in mm, angles in hundredths of a degree.
Json track_json(const Trajectory& trajectory) {
    constexpr const char* names[] = {"t", "x", "y", "z", "roll", "pitch", "yaw"};
    std::vector<Differences> columns(4, Differences(1e-3));
    columns.resize(7, Differences(1e-2));
    for (const TimedPose& pose : trajectory) {
        const Eigen::Vector3d& at = pose.T_world_vehicle.translation;
        const Rpy attitude = rpy_from_rotation(pose.T_world_vehicle.rotation);
        const double values[] = {pose.t_s,
                                 at.x(),
                                 at.y(),
                                 at.z(),
                                 degrees(attitude.roll),
                                 degrees(attitude.pitch),
                                 degrees(attitude.yaw)};
        for (std::size_t k = 0; k < columns.size(); ++k)
            columns[k].add(values[k]);
    }
    Json json;
    for (std::size_t k = 0; k < columns.size(); ++k)
        json[names[k]] = std::move(columns[k]).json();
    return json;
}

std::size_t index_of(std::vector<std::string>& texts, const std::string& text) {
    const auto found = std::ranges::find(texts, text);
    if (found != texts.end()) return static_cast<std::size_t>(found - texts.begin());
    texts.push_back(text);
    return texts.size() - 1;
}

/// The labels of boxes in the order of BoxLabels: name, class of the page, and the outline of an
/// object in the plan.
Json labels_json(const DatasetFile& dataset, std::vector<std::string>& classes) {
    std::vector<std::size_t> numbers;
    for (const std::string& name : dataset.labels.classes)
        numbers.push_back(index_of(classes, name));
    Json labels = Json::array();
    for (std::size_t k = 0; k < dataset.labels.instances.size(); ++k) {
        const Json& instance = dataset.json.at("labels").at("instances").at(k);
        const auto class_id = instance.at("class").get<std::size_t>();
        Json label = {{"name", dataset.labels.instances[k]}, {"class", numbers.at(class_id - 1)}};
        const Json& box = instance.at("box_world_m");
        if (!box.is_null()) {
            label["min"] = {box.at("min").at(0), box.at("min").at(1)};
            label["max"] = {box.at("max").at(0), box.at("max").at(1)};
        }
        labels.push_back(std::move(label));
    }
    for (std::size_t k = 0; k < numbers.size(); ++k)
        labels.push_back({{"name", dataset.labels.classes[k]}, {"class", numbers[k]}});
    return labels;
}

Json mount_json(const Pose& T_vehicle_sensor) {
    const Eigen::Matrix3d r = T_vehicle_sensor.rotation.toRotationMatrix();
    const Eigen::Vector3d& p = T_vehicle_sensor.translation;
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i)
        rows.push_back({r(i, 0), r(i, 1), r(i, 2)});
    return {{"position", {p.x(), p.y(), p.z()}}, {"rotation", std::move(rows)}};
}

Json sensor_json(const fs::path& folder, const Json& sensor, const Sonar& sonar,
                 const CocoBoxes& boxes, const BoxLabels& labels) {
    Json views = views_of(folder, sensor, boxes, labels);
    Json columns = measured_columns(folder, sensor);
    const auto pings = sensor.at("pings").get<std::size_t>();
    const auto every = static_cast<std::uint32_t>(sonar.config.every);
    if (!sonar.head_angles_rad.empty() && !columns.contains("head_angle_rad")) {
        for (std::uint32_t ping = 0; ping < pings; ++ping)
            columns["head_angle_rad"].push_back(short_number(head_angle_rad(sonar, ping * every)));
    }
    std::string note = note_about(sensor, views);
    return {{"name", sensor.at("name")},
            {"kind", name_of(sonar.config.kind)},
            {"every", every},
            {"pings", pings},
            {"range", sonar.config.range_max_m},
            {"azimuth", sonar.settings.view.azimuth_rad},
            {"is_cone", sonar.settings.view.shape == ViewShape::cone},
            {"mount", mount_json(sonar.T_vehicle_sensor)},
            {"note", std::move(note)},
            {"views", std::move(views)},
            {"meta", sensor.at("files").value("meta", Json())},
            {"columns", std::move(columns)}};
}

}  // namespace

Json dataset_json(const fs::path& page, const std::string& member, const DatasetFile& dataset,
                  std::vector<std::string>& classes) {
    const fs::path folder = page / member;
    const Json& description = dataset.json;
    const Mission mission =
        load_mission(folder / mission_name, folder, std::vector<std::string>{}, sonar_keys());
    const Json& sensors = description.at("sensors");
    if (sensors.size() != mission.sensors.size()) {
        throw InputError({(folder / mission_name).string()},
                         "has other sensors than dataset.json; one of them was changed");
    }
    // Tables of the page have a line for each pose, so a false number would take memory.
    const Trajectory trajectory = read_trajectory(folder / trajectory_name);
    if (description.at("poses") != trajectory.size()) {
        throw InputError({(folder / trajectory_name).string()},
                         "has " + std::to_string(trajectory.size()) +
                             " poses, and dataset.json says " + description.at("poses").dump() +
                             "; one of them was changed");
    }
    const BoxLabels labels(dataset);
    const CocoBoxes boxes = coco_boxes(folder, labels);
    const std::map<std::string, Json> unpacked = pictures_in_packs(member, dataset);
    Json shown = Json::array();
    for (std::size_t i = 0; i < mission.sensors.size(); ++i) {
        Json sensor = sensors[i];
        const auto own = unpacked.find(sensor.at("name"));
        if (own != unpacked.end() && sensor.contains("pictures"))
            sensor["pictures"].insert(sensor["pictures"].begin(), own->second.begin(),
                                      own->second.end());
        shown.push_back(sensor_json(folder, sensor,
                                    make_sonar(mission.sensors[i], mission.accuracy, mission.water),
                                    boxes, labels));
    }
    return {{"mission", description.at("mission")},
            {"program", description.at("program_version")},
            {"seed", std::to_string(dataset.seed)},  // JavaScript rounds beyond 2^53
            {"complete", dataset.complete},
            {"poses", dataset.poses},
            {"track", track_json(trajectory)},
            {"statistics", dataset.complete ? label_statistics(folder) : Json()},
            {"objects", dataset.labels.instances.size()},
            {"labels", labels_json(dataset, classes)},
            {"sensors", std::move(shown)}};
}

}  // namespace sonarsim
