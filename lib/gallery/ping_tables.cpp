#include "gallery/ping_tables.h"

#include <optional>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "dataset/file_names.h"
#include "gallery/numbers.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_ping_file = std::size_t{1} << 26;

fs::path file_of(const fs::path& folder, const Json& sensor, const char* kind, std::uint64_t ping) {
    const auto every = sensor.at("every").get<std::uint64_t>();
    return folder / numbered(sensor.at("files").at(kind).get<std::string>(), ping * every);
}

/// The text of a ping's file; nothing where it is not rendered yet.
std::optional<std::string> text_of(const fs::path& file) {
    if (!fs::is_regular_file(file)) return std::nullopt;
    return read_file(file, largest_ping_file);
}

/// Visits every number in a tree of objects, with the names that lead to it.
template <class Visit>
void for_each_number(const std::string& name, const Json& json, const Visit& visit) {
    if (!name.empty() && (json.is_number() || json.is_null())) visit(name, json);
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items())
        for_each_number(name.empty() ? key : name + "." + key, value, visit);
}

void add_or_zero(Json& pings, Json boxes) {
    pings.push_back(boxes.empty() ? Json(0) : std::move(boxes));
}

PictureBoxes boxes_of_coco(const Json& sensor, const CocoBoxes::OfPings& pictures) {
    PictureBoxes all{Json::array(), 0};
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    const auto every = sensor.at("every").get<std::uint64_t>();
    for (std::uint64_t ping = 0; ping < pings; ++ping) {
        const auto own = pictures.find({sensor.at("name"), ping * every});
        add_or_zero(all.pings, own == pictures.end() ? Json() : own->second.boxes);
        if (own != pictures.end()) all.mask_height = own->second.height;
    }
    return all;
}

/// The keys of a box in objects/NNNNNN.json, and the size of its picture.
struct ObjectFrame {
    const char* box;
    const char* x;
    const char* y;
    std::uint64_t width;
    std::uint64_t height;
};

/// `shown` is the object itself, or its part `fan`.
Json box_of_object(const CheckedJson& object, const CheckedJson& shown, const ObjectFrame& frame,
                   const BoxLabels& labels) {
    Json box = {labels.of_instance(object.at("id").whole(1, labels.instances))};
    const CheckedJson corners = shown.at(frame.box);
    const std::vector<CheckedJson> x = corners.at(frame.x).items();
    const std::vector<CheckedJson> y = corners.at(frame.y).items();
    if (x.size() != 2 || y.size() != 2) corners.refuse("two numbers each");
    box.push_back(short_number(x[0].number()));
    box.push_back(short_number(y[0].number()));
    box.push_back(short_number(x[1].number() - x[0].number()));
    box.push_back(short_number(y[1].number() - y[0].number()));
    box.push_back(details_of(object, shown.find("mask"), frame.width, frame.height));
    return box;
}

PingBoxes boxes_of_objects(const fs::path& folder, const Json& sensor, const BoxLabels& labels) {
    ObjectFrame image{"box_bins", "beam", "range", sensor.at("azimuth_edges_rad").size() - 1,
                      sensor.at("range_edges_m").size() - 1};
    ObjectFrame fan{"box_px", "x", "y", 0, 0};
    if (sensor.contains("fan")) {
        fan.width = sensor["fan"].at("width_px");
        fan.height = sensor["fan"].at("height_px");
    }
    PingBoxes all{{Json::array(), image.height}, {Json::array(), fan.height}};
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    for (std::uint64_t ping = 0; ping < pings; ++ping) {
        Json in_image = Json::array();
        Json in_fan = Json::array();
        const fs::path file = file_of(folder, sensor, "objects", ping);
        if (const std::optional<std::string> text = text_of(file)) {
            const Json json = parse_json(*text, file.string());
            const std::string name = file.string();
            for (const CheckedJson& object : CheckedJson(json, name).at("objects").items()) {
                in_image.push_back(box_of_object(object, object, image, labels));
                const std::optional<CheckedJson> shown = object.find("fan");
                if (shown && !shown->json().is_null())
                    in_fan.push_back(box_of_object(object, *shown, fan, labels));
            }
        }
        add_or_zero(all.in_image.pings, std::move(in_image));
        add_or_zero(all.in_fan.pings, std::move(in_fan));
    }
    return all;
}

/// Lines of class, middle, width and height as shares of a picture of this size.
PictureBoxes boxes_of_yolo(const fs::path& folder, const Json& sensor, const char* kind,
                           double width, double height, const BoxLabels& labels) {
    if (!sensor.at("files").contains(kind) || labels.classes == 0) return {};
    PictureBoxes all{Json::array(), 0};
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    for (std::uint64_t ping = 0; ping < pings; ++ping) {
        Json boxes = Json::array();
        const fs::path file = file_of(folder, sensor, kind, ping);
        std::istringstream lines(text_of(file).value_or(""));
        std::size_t number = 0;
        double x = 0.0;
        double y = 0.0;
        double w = 0.0;
        double h = 0.0;
        while (lines >> number >> x >> y >> w >> h) {
            if (number >= labels.classes) {
                throw InputError({file.string()},
                                 "has a class that dataset.json does not; run sonarsim verify");
            }
            boxes.push_back({labels.of_class(number), short_number((x - 0.5 * w) * width),
                             short_number((y - 0.5 * h) * height), short_number(w * width),
                             short_number(h * height), Json::object()});
        }
        add_or_zero(all.pings, std::move(boxes));
    }
    return all;
}

PingBoxes boxes_of_files(const fs::path& folder, const Json& sensor, const BoxLabels& labels) {
    const Json& files = sensor.at("files");
    if (!sensor.contains("azimuth_edges_rad")) return {};
    if (files.contains("objects")) return boxes_of_objects(folder, sensor, labels);
    const auto bins = [&](const char* edges) {
        return static_cast<double>(sensor.at(edges).size()) - 1.0;
    };
    PingBoxes all;
    all.in_image = boxes_of_yolo(folder, sensor, "yolo", bins("azimuth_edges_rad"),
                                 bins("range_edges_m"), labels);
    if (sensor.contains("fan")) {
        const Json& fan = sensor["fan"];
        all.in_fan = boxes_of_yolo(folder, sensor, "fan_yolo", fan.at("width_px"),
                                   fan.at("height_px"), labels);
    }
    return all;
}

}  // namespace

Json measured_columns(const fs::path& folder, const Json& sensor) {
    Json columns = Json::object();
    if (!sensor.at("files").contains("meta")) return columns;
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    for (std::uint64_t ping = 0; ping < pings; ++ping) {
        const fs::path file = file_of(folder, sensor, "meta", ping);
        const std::optional<std::string> text = text_of(file);
        if (!text) continue;
        const auto put = [&](const std::string& name, const Json& value) {
            Json& column = columns[name];
            if (column.is_null()) column = Json(pings, nullptr);
            if (value.is_number()) column[ping] = short_number(value.get<double>());
        };
        use_json(file, *text, [&](const Json& meta) {
            for_each_number("", meta.value("measured", Json()), put);
            for (const char* name :
                 {"estimated_error", "estimated_missed_multipath", "clipped_pixels"}) {
                if (meta.contains(name)) put(name, meta[name]);
            }
        });
    }
    return columns;
}

PingBoxes ping_boxes(const fs::path& folder, const Json& sensor, const CocoBoxes& coco,
                     const BoxLabels& labels) {
    PingBoxes all;
    if (coco.in_image.empty() || coco.in_fan.empty()) all = boxes_of_files(folder, sensor, labels);
    if (!coco.in_image.empty()) all.in_image = boxes_of_coco(sensor, coco.in_image);
    if (!coco.in_fan.empty()) all.in_fan = boxes_of_coco(sensor, coco.in_fan);
    return all;
}

}  // namespace sonarsim
