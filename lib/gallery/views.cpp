#include "gallery/views.h"

#include <utility>

#include "core/file.h"
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

constexpr std::size_t largest_coco = std::size_t{1} << 30;

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

/// Boxes that labels/coco_records.json has in a picture, where it is shown as `along` says.
Json record_boxes(const fs::path& folder, const Json& description, const std::string& file,
                  const Along& along, BoxLabels& labels) {
    const fs::path coco = folder / "labels/coco_records.json";
    if (!fs::is_regular_file(coco)) return nullptr;
    const Json all = Json::parse(read_file(coco, largest_coco));
    Json boxes = nullptr;
    for (const Json& image : all.at("images")) {
        if (image.at("file_name") != file) continue;
        boxes = Json::array();
        for (const Json& annotation : all.at("annotations")) {
            if (annotation.at("image_id") != image.at("id")) continue;
            const auto instance = annotation.at("instance_id").get<std::size_t>();
            const Json& b = annotation.at("bbox");
            boxes.push_back(
                {labels.index_of(
                     description.at("labels").at("instances").at(instance - 1).at("name")),
                 along.origin[0] + b[0].get<double>() * along.step[0],
                 along.origin[1] + b[1].get<double>() * along.step[1],
                 b[2].get<double>() * along.step[0], b[3].get<double>() * along.step[1]});
        }
    }
    return boxes;
}

Json view_of_all(const fs::path& folder, const Json& description, const Sonar& sonar,
                 std::size_t pings, const std::string& file, const std::string& name,
                 BoxLabels& labels) {
    const double per_ping = static_cast<double>(picture_rows(pings)) / static_cast<double>(pings);
    const bool waterfall = name == "waterfall_view.png";
    const Along along = waterfall ? along_waterfall(sonar.config, per_ping)
                                  : along_echogram(sonar.config, pings, per_ping);
    const std::string labelled =
        sonar.config.name + (waterfall ? "/waterfall.png" : "/echogram.png");
    Json view = {{"title", waterfall ? "waterfall" : "echogram"},
                 {"file", file},
                 {"along", along.axis},
                 {"origin", along.origin},
                 {"step", along.step}};
    Json boxes = record_boxes(folder, description, labelled, along, labels);
    if (!boxes.is_null()) view["boxes"] = std::move(boxes);
    return view;
}

Json view_of_scans(const Sonar& sonar, const std::string& file, const Json& scan) {
    const FanFrame frame = fan_frame(whole_scan(sonar), 0);
    return {{"title", "scan"},
            {"file", file},
            {"per", "sweep"},
            {"pings", scan.at("pings_per_sweep")},
            {"radius", sonar.config.range_max_m / frame.pixel_m / frame.width}};
}

}  // namespace

Json views_of(const fs::path& folder, const Json& description, const Json& sensor,
              const Sonar& sonar, BoxLabels& labels) {
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
    bool scans = false;
    for (const Json& product : sensor.value("products", Json::array())) {
        const auto file = product.get<std::string>();
        const fs::path path(file);
        const std::string name = path.filename().string();
        if (path.extension() != ".png" || name == "waterfall.png" || name == "echogram.png")
            continue;
        if (name == "waterfall_view.png" || name == "echogram_view.png") {
            views.push_back(view_of_all(folder, description, sonar, pings, file, name, labels));
        } else if (sensor.contains("scan") && name.starts_with("scan_")) {
            // One view for all sweeps.
            if (!std::exchange(scans, true)) {
                views.push_back(view_of_scans(
                    sonar, (path.parent_path() / "scan_%04d.png").string(), sensor["scan"]));
            }
        } else {
            views.push_back({{"title", path.stem().string()}, {"file", file}});
        }
    }
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
