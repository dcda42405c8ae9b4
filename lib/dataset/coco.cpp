#include "dataset/coco.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

#include "core/file.h"
#include "dataset/whole_file.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_objects_file = std::size_t{1} << 30;

/// The pictures of a sensor that a COCO file lists.
struct PictureSeries {
    PingFile picture;
    PingFile objects;
    std::uint64_t width = 0;
    std::uint64_t height = 0;
};

std::optional<PingFile> file_named(const SensorLayout& sensor, std::string_view name) {
    for (const auto& part : sensor.per_ping) {
        const auto* file = std::get_if<PingFile>(&part);
        if (file && file->name == name) return *file;
    }
    return std::nullopt;
}

/// Nothing for a sensor without such pictures.
std::optional<PictureSeries> series_of(const SensorLayout& sensor, const Json& described,
                                       Picture picture) {
    const bool is_fan = picture == Picture::fan;
    auto shown = file_named(sensor, is_fan ? "fan" : "image");
    if (!shown && !is_fan) shown = file_named(sensor, "polar");
    const auto objects = file_named(sensor, "objects");
    if (!shown || !objects) return std::nullopt;
    PictureSeries series{*shown, *objects};
    if (is_fan) {
        series.width = described.at("fan").at("width_px");
        series.height = described.at("fan").at("height_px");
    } else {
        series.width = described.at("azimuth_edges_rad").size() - 1;
        series.height = described.at("range_edges_m").size() - 1;
    }
    return series;
}

/// [left, top, width, height] of half-open intervals in x and y.
Json box_of(const Json& x, const Json& y) {
    const auto length = [](const Json& interval) {
        return interval.at(1).get<std::int64_t>() - interval.at(0).get<std::int64_t>();
    };
    return {x.at(0), y.at(0), length(x), length(y)};
}

/// What the picture shows of an object; null where it shows nothing.
Json annotation_of(const Json& object, const PictureSeries& series, Picture picture,
                   std::uint64_t image_id, const Json& class_ids) {
    const bool is_fan = picture == Picture::fan;
    const Json& shown = is_fan ? object.at("fan") : object;
    if (shown.is_null()) return nullptr;
    const Json& box = shown.at(is_fan ? "box_px" : "box_bins");
    const auto instance = object.at("id").get<std::uint64_t>();
    return {
        {"id", image_id * 65536 + instance},
        {"image_id", image_id},
        {"category_id", class_ids.at(object.at("class").get<std::string>())},
        {"instance_id", instance},
        {"bbox",
         is_fan ? box_of(box.at("x"), box.at("y")) : box_of(box.at("beam"), box.at("range"))},
        {"area", shown.at(is_fan ? "area_px" : "area_bins")},
        {"segmentation", {{"size", {series.height, series.width}}, {"counts", shown.at("mask")}}},
        {"iscrowd", 0}};
}

/// A JSON list that is written item by item.
class StreamedList {
  public:
    StreamedList(StreamedFile& file, const char* key) : file_(file) {
        file_.append(std::string("\"") + key + "\": [");
    }
    void add(const Json& item) {
        file_.append(first_ ? "\n" : ",\n");
        file_.append(item.dump(-1, ' ', false, Json::error_handler_t::replace));
        first_ = false;
    }
    void finish() { file_.append("\n]"); }

  private:
    StreamedFile& file_;
    bool first_ = true;
};

}  // namespace

void write_coco(const Layout& layout, const Json& description, const SharedProduct& product,
                const std::vector<SplitPart>& part_of_pose) {
    std::vector<std::optional<PictureSeries>> series;
    for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
        series.push_back(
            series_of(layout.sensors[i], description.at("sensors").at(i), product.picture));
    }
    Json class_ids = Json::object();
    for (const Json& one : description.at("labels").at("classes"))
        class_ids[one.at("name").get<std::string>()] = one.at("id");

    const auto for_each_picture =
        [&](const std::function<void(const PingId&, const PictureSeries&, std::uint64_t)>& visit) {
            std::uint64_t index = 0;
            for (std::uint32_t pose = 0; pose < part_of_pose.size(); ++pose) {
                for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
                    if (pose % layout.sensors[i].every != 0) continue;
                    const std::uint64_t id =
                        2 * ++index - 1 + (product.picture == Picture::fan ? 1 : 0);
                    const bool listed =
                        product.part == SplitPart::none || product.part == part_of_pose[pose];
                    if (listed && series[i]) visit({pose, i}, *series[i], id);
                }
            }
        };

    StreamedFile out(layout.folder / product.file);
    out.append("{\"info\": ");
    out.append(Json{{"description", description.at("mission")},
                    {"version", description.at("program_version")}}
                   .dump());
    out.append(",\n\"licenses\": [],\n");
    StreamedList categories(out, "categories");
    for (const Json& one : description.at("labels").at("classes")) {
        categories.add(
            {{"id", one.at("id")}, {"name", one.at("name")}, {"supercategory", "object"}});
    }
    categories.finish();
    out.append(",\n");
    StreamedList images(out, "images");
    for_each_picture([&](const PingId& ping, const PictureSeries& shown, std::uint64_t id) {
        images.add(
            {{"id", id},
             {"file_name",
              layout.file(ping, shown.picture).lexically_relative(layout.folder).generic_string()},
             {"width", shown.width},
             {"height", shown.height},
             {"sensor", layout.sensors[ping.sensor].name},
             {"ping", ping.pose}});
    });
    images.finish();
    out.append(",\n");
    StreamedList annotations(out, "annotations");
    for_each_picture([&](const PingId& ping, const PictureSeries& shown, std::uint64_t id) {
        const std::filesystem::path file = layout.file(ping, shown.objects);
        const Json objects = Json::parse(read_file(file, largest_objects_file));
        for (const Json& object : objects.at("objects")) {
            const Json annotation = annotation_of(object, shown, product.picture, id, class_ids);
            if (!annotation.is_null()) annotations.add(annotation);
        }
    });
    annotations.finish();
    out.append("}\n");
    out.finish();
}

}  // namespace sonarsim
