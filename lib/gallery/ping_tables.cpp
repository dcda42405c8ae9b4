#include "gallery/ping_tables.h"

#include <charconv>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "dataset/file_names.h"

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

/// Every number in a tree, by the names on the way to it.
template <class Visit>
void for_each_number(const std::string& name, const Json& json, const Visit& visit) {
    if (!name.empty() && (json.is_number() || json.is_null())) visit(name, json);
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items())
        for_each_number(name.empty() ? key : name + "." + key, value, visit);
}

Json box(std::size_t label, double left, double top, double right, double bottom) {
    const auto tenth = [](double pixels) { return short_number(pixels); };
    return {label, tenth(left), tenth(top), tenth(right - left), tenth(bottom - top)};
}

void add_or_zero(Json& pings, Json&& boxes) {
    pings.push_back(boxes.empty() ? Json(0) : std::move(boxes));
}

/// Adds the boxes of a ping to those of the picture and those of the fan.
void add_boxes(const Json& objects, BoxLabels& labels, Json& image, Json& fan) {
    for (const Json& object : objects) {
        const std::size_t label =
            labels.index_of(object_text(object.at("name"), object.at("class")));
        const Json& bins = object.at("box_bins");
        image.push_back(box(label, bins.at("beam").at(0), bins.at("range").at(0),
                            bins.at("beam").at(1), bins.at("range").at(1)));
        if (!object.contains("fan") || object.at("fan").is_null()) continue;
        const Json& px = object.at("fan").at("box_px");
        fan.push_back(
            box(label, px.at("x").at(0), px.at("y").at(0), px.at("x").at(1), px.at("y").at(1)));
    }
}

PingBoxes boxes_of_objects(const fs::path& folder, const Json& sensor, BoxLabels& labels) {
    PingBoxes all{Json::array(), Json::array()};
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    for (std::uint64_t ping = 0; ping < pings; ++ping) {
        Json image = Json::array();
        Json fan = Json::array();
        const fs::path file = file_of(folder, sensor, "objects", ping);
        if (const std::optional<std::string> text = text_of(file)) {
            use_json(file, *text,
                     [&](const Json& json) { add_boxes(json.at("objects"), labels, image, fan); });
        }
        add_or_zero(all.in_image, std::move(image));
        add_or_zero(all.in_fan, std::move(fan));
    }
    return all;
}

/// Lines of class, middle, width and height as shares of a picture of this size.
Json boxes_of_yolo(const fs::path& folder, const Json& description, const Json& sensor,
                   const char* kind, double width, double height, BoxLabels& labels) {
    if (!sensor.at("files").contains(kind)) return nullptr;
    if (!description.contains("labels")) return nullptr;
    const Json& classes = description["labels"].at("classes");
    Json all = Json::array();
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
            if (number >= classes.size()) {
                throw InputError({file.string()},
                                 "has a class that dataset.json does not; run sonarsim verify");
            }
            const std::size_t label = labels.index_of(classes[number].at("name"));
            boxes.push_back(box(label, (x - 0.5 * w) * width, (y - 0.5 * h) * height,
                                (x + 0.5 * w) * width, (y + 0.5 * h) * height));
        }
        add_or_zero(all, std::move(boxes));
    }
    return all;
}

}  // namespace

Json short_number(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 5);
    double rounded = 0.0;
    std::from_chars(text, end.ptr, rounded);
    return rounded;
}

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
            for (const char* name : {"estimated_error", "clipped_pixels"}) {
                if (meta.contains(name)) put(name, meta[name]);
            }
        });
    }
    return columns;
}

PingBoxes ping_boxes(const fs::path& folder, const Json& description, const Json& sensor,
                     BoxLabels& labels) {
    const Json& files = sensor.at("files");
    if (files.contains("objects")) return boxes_of_objects(folder, sensor, labels);
    if (!files.contains("yolo") && !files.contains("fan_yolo")) return {};
    PingBoxes all;
    const auto bins = [&](const char* edges) {
        return static_cast<double>(sensor.at(edges).size()) - 1.0;
    };
    if (!sensor.contains("azimuth_edges_rad")) return {};
    all.in_image = boxes_of_yolo(folder, description, sensor, "yolo", bins("azimuth_edges_rad"),
                                 bins("range_edges_m"), labels);
    if (sensor.contains("fan")) {
        const Json& fan = sensor["fan"];
        all.in_fan = boxes_of_yolo(folder, description, sensor, "fan_yolo", fan.at("width_px"),
                                   fan.at("height_px"), labels);
    }
    return all;
}

}  // namespace sonarsim
