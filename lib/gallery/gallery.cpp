#include "gallery/gallery.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/pose.h"
#include "core/units.h"
#include "dataset/dataset_file.h"
#include "dataset/layout.h"
#include "gallery/content_policy.h"
#include "gallery/page.h"
#include "gallery/views.h"
#include "job/collection.h"
#include "job/variants.h"
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

/// The outlines of the labelled objects in the plan.
Json objects_json(const Json& description) {
    Json objects = Json::array();
    const std::vector<std::string> texts = object_texts(description);
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const Json& box = description["labels"]["instances"][k].at("box_world_m");
        if (box.is_null()) continue;
        objects.push_back({{"name", texts[k]},
                           {"min", {box.at("min").at(0), box.at("min").at(1)}},
                           {"max", {box.at("max").at(0), box.at("max").at(1)}}});
    }
    return objects;
}

Json mount_json(const Pose& T_vehicle_sensor) {
    const Eigen::Matrix3d r = T_vehicle_sensor.rotation.toRotationMatrix();
    const Eigen::Vector3d& p = T_vehicle_sensor.translation;
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i)
        rows.push_back({r(i, 0), r(i, 1), r(i, 2)});
    return {{"position", {p.x(), p.y(), p.z()}}, {"rotation", std::move(rows)}};
}

Json sensor_json(const fs::path& folder, const Json& description, const Json& sensor,
                 const Sonar& sonar, const PictureBoxes& boxes, BoxLabels& labels) {
    Json views = views_of(folder, description, sensor, boxes, labels);
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

Json page_json(const fs::path& folder, const Json& description) {
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
    BoxLabels labels;
    const PictureBoxes boxes = picture_boxes(folder, description, labels);
    Json shown = Json::array();
    for (std::size_t i = 0; i < mission.sensors.size(); ++i) {
        shown.push_back(sensor_json(folder, description, sensors[i],
                                    make_sonar(mission.sensors[i], mission.accuracy, mission.water),
                                    boxes, labels));
    }
    return {
        {"mission", description.at("mission")},   {"program", description.at("program_version")},
        {"seed", description.at("seed").dump()},  // JavaScript rounds beyond 2^53
        {"complete", description.at("complete")}, {"poses", description.at("poses")},
        {"track", track_json(trajectory)},        {"objects", objects_json(description)},
        {"labels", std::move(labels.texts)},      {"sensors", std::move(shown)}};
}

void replace(std::string& text, std::string_view place, std::string_view by) {
    text.replace(text.find(place), place.size(), by);
}

/// JSON in which nothing can be taken for the end of its element.
std::string inline_json(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        c == '<' ? void(safe += "\\u003c") : void(safe += c);
    return safe;
}

void require_one_dataset(const fs::path& folder) {
    const bool many = read_variants(folder).has_value() || !collected_folders(folder).empty();
    if (!many) return;
    throw InputError({folder.string()},
                     "holds several datasets; give the folder of one of them, such as " +
                         (folder / "variant_0000").string());
}

}  // namespace

GallerySummary write_gallery(const fs::path& folder) {
    require_one_dataset(folder);
    const Json description = require_dataset(folder).json;
    const fs::path file = folder / gallery_name;
    if (fs::exists(fs::symlink_status(file)) && !has_gallery(folder)) {
        throw InputError({file.string()},
                         "is not of sonarsim's making, and would be replaced; move it away");
    }
    const Json json = page_json(folder, description);
    std::string page(page_html());
    replace(page, "<!--page.css-->", page_css());
    replace(page, "<!--page.js-->", page_js());
    replace(page, "<!--policy-->", content_policy(page));
    replace(page, "<!--dataset-->", inline_json(json));
    write_file(file, page);
    GallerySummary summary{file, page.size(), 0};
    for (const Json& sensor : json.at("sensors"))
        summary.pings += sensor.at("pings").get<std::uint64_t>();
    return summary;
}

}  // namespace sonarsim
