#include "gallery/views.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "dataset/file_names.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Moves and scales four numbers, x, y, width, height, from the picture that COCO lists to the one
/// that is shown.
void move_box(Json& box, std::size_t first, const Json& picture) {
    for (std::size_t k = 0; k < 4; ++k) {
        const bool is_corner = k < 2;
        const std::size_t axis = k % 2;
        const double origin = is_corner ? picture.at("origin_px").at(axis).get<double>() : 0.0;
        Json& number = box.at(first + k);
        number = origin + number.get<double>() * picture.at("pixel_px").at(axis).get<double>();
    }
}

Json boxes_in_view(const Json& boxes, const Json& picture) {
    Json moved = boxes;
    for (Json& box : moved) {
        move_box(box, 1, picture);
        Json& details = box.at(5);
        if (details.contains("shadow_bbox")) move_box(details["shadow_bbox"], 0, picture);
    }
    return moved;
}

void add_view_of_pings(const Json& picture, const PingBoxes& boxes, Json& view) {
    view["per"] = "ping";
    if (picture.value("unpacked", false)) view["unpacked"] = true;
    if (picture.value("ahead", "") == "down") view["turned"] = true;
    if (!picture.contains("boxes_of")) return;
    const PictureBoxes& own = picture["boxes_of"] == "fan" ? boxes.in_fan : boxes.in_image;
    if (own.pings.is_null()) return;
    view["boxes"] = own.pings;
    view["mask_height"] = own.mask_height;
}

void add_view_of_sweeps(const Json& picture, std::uint64_t pings, const CocoBoxes& coco,
                        Json& view) {
    const auto pings_per_sweep = picture.at("pings").get<std::uint64_t>();
    view["per"] = "sweep";
    view["pings"] = pings_per_sweep;
    view["radius"] = picture.at("radius_px").get<double>() / picture.at("width_px").get<double>();
    const auto boxes_of = [&](std::uint64_t sweep) {
        return coco.of_file.find(numbered(picture.value("boxes_of", ""), sweep));
    };
    if (boxes_of(0) == coco.of_file.end()) return;
    view["mask_height"] = boxes_of(0)->second.height;
    view["boxes"] = Json::array();
    for (std::uint64_t sweep = 0; sweep * pings_per_sweep < pings; ++sweep) {
        const auto own = boxes_of(sweep);
        view["boxes"].push_back(own == coco.of_file.end() ? Json::array() : own->second.boxes);
    }
}

/// A picture of all pings.
void add_view_of_sensor(const Json& picture, const CocoBoxes& coco, Json& view) {
    if (!picture.contains("pings_along")) return;
    const std::size_t axis = picture["pings_along"] == "x" ? 0 : 1;
    Json step = picture.at("pixel_px");
    step[axis] = step[axis].get<double>() / picture.at("pings_per_pixel").get<double>();
    view["along"] = picture["pings_along"];
    view["origin"] = picture.at("origin_px");
    view["step"] = std::move(step);
    view["pixel"] = picture.at("pixel_px");
    const auto own = coco.of_file.find(picture.value("boxes_of", ""));
    if (own == coco.of_file.end()) return;
    view["boxes"] = boxes_in_view(own->second.boxes, picture);
    view["mask_height"] = own->second.height;
}

}  // namespace

Json views_of(const fs::path& folder, const Json& sensor, const CocoBoxes& coco,
              const BoxLabels& labels) {
    if (!sensor.contains("pictures")) {
        throw InputError(
            {(folder / description_name).string()},
            "lists no pictures of sensor '" + sensor.at("name").get<std::string>() +
                "', since an older sonarsim wrote it; make the page with that version, "
                "or render the dataset again");
    }
    Json views = Json::array();
    const PingBoxes boxes = ping_boxes(folder, sensor, coco, labels);
    for (const Json& picture : sensor["pictures"]) {
        Json view = {{"title", picture.at("title")}, {"file", picture.at("file")}};
        const Json& per = picture.at("per");
        if (per == "ping") add_view_of_pings(picture, boxes, view);
        if (per == "sweep") add_view_of_sweeps(picture, sensor.at("pings"), coco, view);
        if (per == "sensor") add_view_of_sensor(picture, coco, view);
        views.push_back(std::move(view));
    }
    return views;
}

std::string note_about(const Json& sensor, const Json& views) {
    const auto name = sensor.at("name").get<std::string>();
    if (sensor.contains("packs")) {
        return "The files of single pings are in tar archives. The pictures were copied out of "
               "them; "
               "the measurements are not shown.";
    }
    if (!views.empty()) return {};
    if (sensor.at("files").contains("polar")) {
        return "The pings of " + name +
               " are arrays, which a browser does not open from a folder: render with "
               "output.fan or output.image set to true.";
    }
    return "The dataset has no pictures of " + name + ".";
}

}  // namespace sonarsim
