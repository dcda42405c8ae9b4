#include "gallery/views.h"

#include <string>
#include <utility>
#include <vector>

#include "dataset/folded_records.h"
#include "product/echogram.h"
#include "product/fan.h"
#include "product/scan.h"
#include "product/sidescan_row.h"
#include "product/waterfall.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A picture of every ping.
struct PingPicture {
    const char* kind;  ///< among the files of the sensor
    const char* title;
    bool turned;
    Json PingBoxes::*boxes;  ///< null: it has none
};

constexpr PingPicture ping_pictures[] = {
    {"fan", "fan", false, &PingBoxes::in_fan},
    {"image", "polar", true, &PingBoxes::in_image},
    {"raw", "raw", true, &PingBoxes::in_image},
    {"stages", "stages", false, nullptr},
    {"fan_semantic", "classes, fan", false, &PingBoxes::in_fan},
    {"semantic", "classes, polar", true, &PingBoxes::in_image},
};

/// Where the pings lie in a picture of all of them.
struct Along {
    const char* axis;
    double origin[2];
    double step[2];
};

Along along_waterfall(const SonarConfig& config, double rows_per_ping) {
    return {"y", {0.0, static_cast<double>(waterfall_axis(config).height)}, {1.0, rows_per_ping}};
}

Along along_echogram(const SonarConfig& config, std::size_t pings, double columns_per_ping) {
    const EchogramFrame frame = echogram_frame(config, picture_rows(pings));
    return {"x",
            {static_cast<double>(frame.axis_width), 0.0},
            {columns_per_ping * frame.ping_width, static_cast<double>(frame.range_height)}};
}

/// Boxes of a picture with a row, or column, of a pixel for each ping, in the one that is shown.
Json boxes_along(const Json& boxes, const Along& along) {
    Json moved = Json::array();
    for (const Json& box : boxes) {
        Json one = {box.at(0)};
        for (const int axis : {0, 1})
            one.push_back(along.origin[axis] + box.at(1 + axis).get<double>() * along.step[axis]);
        for (const int axis : {0, 1})
            one.push_back(box.at(3 + axis).get<double>() * along.step[axis]);
        moved.push_back(std::move(one));
    }
    return moved;
}

Json view_of_all(const Sonar& sonar, std::size_t pings, const fs::path& file,
                 const PictureBoxes& boxes) {
    const double per_ping = static_cast<double>(picture_rows(pings)) / static_cast<double>(pings);
    const bool waterfall = file.filename() == "waterfall_view.png";
    const Along along = waterfall ? along_waterfall(sonar.config, per_ping)
                                  : along_echogram(sonar.config, pings, per_ping);
    Json view = {{"title", waterfall ? "waterfall" : "echogram"},
                 {"file", file.string()},
                 {"along", along.axis},
                 {"origin", along.origin},
                 {"step", along.step}};
    const auto labelled =
        boxes.find((file.parent_path() / (waterfall ? "waterfall.png" : "echogram.png")).string());
    if (labelled != boxes.end()) view["boxes"] = boxes_along(labelled->second, along);
    return view;
}

/// One view for all sweeps; `files` are their pictures.
Json view_of_scans(const Sonar& sonar, const std::vector<std::string>& files, const Json& scan,
                   const PictureBoxes& boxes) {
    const FanFrame frame = fan_frame(whole_scan(sonar), 0);
    Json view = {{"title", "scan"},
                 {"file", (fs::path(files.front()).parent_path() / "scan_%04d.png").string()},
                 {"per", "sweep"},
                 {"pings", scan.at("pings_per_sweep")},
                 {"radius", sonar.config.range_max_m / frame.pixel_m / frame.width}};
    if (!boxes.contains(files.front())) return view;
    view["boxes"] = Json::array();
    for (const std::string& file : files) {
        const auto own = boxes.find(file);
        view["boxes"].push_back(own == boxes.end() ? Json::array() : own->second);
    }
    return view;
}

}  // namespace

Json views_of(const fs::path& folder, const Json& description, const Json& sensor,
              const Sonar& sonar, const PictureBoxes& picture_boxes, BoxLabels& labels) {
    Json views = Json::array();
    const Json& files = sensor.at("files");
    const PingBoxes boxes = ping_boxes(folder, description, sensor, labels);
    for (const PingPicture& picture : ping_pictures) {
        if (!files.contains(picture.kind)) continue;
        Json view = {{"title", picture.title}, {"file", files[picture.kind]}, {"per", "ping"}};
        if (picture.turned) view["turned"] = true;
        if (picture.boxes && !(boxes.*picture.boxes).is_null())
            view["boxes"] = boxes.*picture.boxes;
        views.push_back(std::move(view));
    }
    const auto pings = sensor.at("pings").get<std::size_t>();
    std::vector<std::string> scans;
    for (const Json& product : sensor.value("products", Json::array())) {
        const auto file = product.get<std::string>();
        const fs::path path(file);
        const std::string name = path.filename().string();
        const bool for_programs = name == "waterfall.png" || name == "echogram.png" ||
                                  name == "raw.png" || name.starts_with("raw_");
        if (path.extension() != ".png" || for_programs) continue;
        if (name == "waterfall_view.png" || name == "echogram_view.png") {
            views.push_back(view_of_all(sonar, pings, path, picture_boxes));
        } else if (sensor.contains("scan") && name.starts_with("scan_")) {
            scans.push_back(file);
        } else {
            views.push_back({{"title", path.stem().string()}, {"file", file}});
        }
    }
    if (!scans.empty()) views.push_back(view_of_scans(sonar, scans, sensor["scan"], picture_boxes));
    return views;
}

std::string note_about(const Json& sensor, const Json& views) {
    const auto name = sensor.at("name").get<std::string>();
    if (sensor.contains("packs")) {
        return "The files of single pings are in tar archives, which a browser does not open: "
               "there are no pictures and numbers of them here. Render with output.pack: none.";
    }
    if (!views.empty()) return {};
    if (sensor.at("files").contains("polar")) {
        return "The pings of " + name +
               " are arrays (.npy), which a browser does not open from a folder: render with "
               "output.fan or output.image set to true.";
    }
    return "The dataset has no pictures of " + name + ".";
}

}  // namespace sonarsim
