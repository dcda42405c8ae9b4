#include <array>
#include <functional>
#include <optional>
#include <stdexcept>

#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/ping_file_reader.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

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
                                       CocoPicture picture) {
    const bool is_fan = picture == CocoPicture::fan;
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

/// The annotation of an object; nothing if the picture does not show it.
std::optional<CocoAnnotation> annotation_of(const Json& object, const PictureSeries& series,
                                            CocoPicture picture, std::uint64_t image_id,
                                            const Json& class_ids) {
    const bool is_fan = picture == CocoPicture::fan;
    const Json& shown = is_fan ? object.at("fan") : object;
    if (shown.is_null()) return std::nullopt;
    const Json& box = shown.at(is_fan ? "box_px" : "box_bins");
    const auto x = box.at(is_fan ? "x" : "beam").get<std::array<std::int64_t, 2>>();
    const auto y = box.at(is_fan ? "y" : "range").get<std::array<std::int64_t, 2>>();
    const auto instance = object.at("id").get<std::uint64_t>();
    return CocoAnnotation{.id = image_id * ids_per_image + instance,
                          .image_id = image_id,
                          .instance = instance,
                          .category = class_ids.at(object.at("class").get<std::string>()),
                          .left = x[0],
                          .top = y[0],
                          .width = x[1] - x[0],
                          .height = y[1] - y[0],
                          .area = shown.at(is_fan ? "area_px" : "area_bins"),
                          .image_width = series.width,
                          .image_height = series.height,
                          .counts = shown.at("mask")};
}

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
                        2 * ++index - 1 + (product.picture == CocoPicture::fan ? 1 : 0);
                    const bool listed =
                        product.part == SplitPart::none || product.part == part_of_pose[pose];
                    if (listed && series[i]) visit({pose, i}, *series[i], id);
                }
            }
        };

    CocoFile out(layout.folder / product.file, description);
    out.begin_list("images");
    for_each_picture([&](const PingId& ping, const PictureSeries& shown, std::uint64_t id) {
        out.add({{"id", id},
                 {"file_name", place_of_file(layout, ping, shown.picture)},
                 {"width", shown.width},
                 {"height", shown.height},
                 {"sensor", layout.sensors[ping.sensor].name},
                 {"ping", ping.pose}});
    });
    out.end_list();
    out.begin_list("annotations");
    PingFileReader reader(layout);
    for_each_picture([&](const PingId& ping, const PictureSeries& shown, std::uint64_t id) {
        const Json objects = Json::parse(reader.read(ping, shown.objects));
        for (const Json& object : objects.at("objects")) {
            if (const auto found = annotation_of(object, shown, product.picture, id, class_ids))
                out.add(annotation_json(*found));
        }
    });
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
