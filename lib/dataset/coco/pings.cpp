#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/units.h"
#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/label_description.h"
#include "dataset/ping_file_reader.h"
#include "mission/dataset_names.h"

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

/// The ids of classes by their names, and the rules of annotations.
struct ClassTable {
    std::map<std::string, std::uint64_t> ids;
    AnnotationRules rules;
};

ClassTable class_table(const Json& description) {
    const std::string file = description_name;
    ClassTable table{{}, annotation_rules({description.at("labels"), file})};
    for (const Json& one : description.at("labels").at("classes"))
        table.ids[one.at("name").get<std::string>()] = one.at("id");
    return table;
}

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

std::optional<double> number_of(const Json& json, const char* key) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

/// A box of the table of objects; nothing for none.
std::optional<PixelBox> box_of(const Json& json, const char* key, bool is_fan) {
    const auto found = json.find(key);
    if (found == json.end()) return std::nullopt;
    const auto x = found->at(is_fan ? "x" : "beam").get<std::array<int, 2>>();
    const auto y = found->at(is_fan ? "y" : "range").get<std::array<int, 2>>();
    return PixelBox{x[0], x[1], y[0], y[1]};
}

SeenFacts facts_of(const Json& object, bool is_fan) {
    SeenFacts seen;
    seen.range_m = number_of(object, "range_m");
    if (const auto azimuth_rad = number_of(object, "azimuth_rad"))
        seen.bearing_deg = -degrees(*azimuth_rad);
    seen.contrast_db = number_of(object, "contrast_db");
    seen.visible_share = number_of(object, "visible_share");
    const auto shadow = object.find("shadow");
    if (shadow == object.end()) return seen;
    seen.shadow_contrast_db = number_of(*shadow, "contrast_db");
    seen.shadow = is_fan ? box_of(object.at("fan"), "shadow_box_px", true)
                         : box_of(*shadow, "box_bins", false);
    return seen;
}

/// The annotation of an object by the rules; nothing if the picture does not annotate it.
std::optional<CocoAnnotation> annotation_of(const Json& object, const PictureSeries& series,
                                            CocoPicture picture, std::uint64_t image_id,
                                            const ClassTable& classes) {
    const bool is_fan = picture == CocoPicture::fan;
    const Json& shown = is_fan ? object.at("fan") : object;
    if (shown.is_null()) return std::nullopt;
    const PixelBox box = box_of(shown, is_fan ? "box_px" : "box_bins", is_fan).value();
    const auto instance = object.at("id").get<std::uint64_t>();
    const std::uint64_t class_id = classes.ids.at(object.at("class").get<std::string>());
    CocoAnnotation annotation{.id = image_id * ids_per_image + instance,
                              .image_id = image_id,
                              .instance = instance,
                              .category = class_id,
                              .left = box.left,
                              .top = box.top,
                              .width = box.right - box.left,
                              .height = box.bottom - box.top,
                              .area = shown.at(is_fan ? "area_px" : "area_bins"),
                              .image_width = series.width,
                              .image_height = series.height,
                              .counts = shown.at("mask"),
                              .seen = facts_of(object, is_fan)};
    const bool is_background = classes.rules.is_background(class_id - 1);
    if (!apply_rules(classes.rules.config, is_background, annotation)) return std::nullopt;
    return annotation;
}

/// A COCO file while it is written.
struct OpenCoco {
    const SharedProduct& product;
    std::vector<std::optional<PictureSeries>> series;  ///< indexed by sensor
    std::unique_ptr<CocoFile> file;

    /// True for a ping whose picture it lists.
    bool lists(const PingId& ping, const std::vector<SplitPart>& part_of_pose) const {
        return series[ping.sensor] &&
               (product.part == SplitPart::none || product.part == part_of_pose[ping.pose]);
    }
    /// The id of the picture of the ping with this index in the mission.
    std::uint64_t image_id(std::uint64_t index) const {
        return 2 * index + (product.picture == CocoPicture::fan ? 2 : 1);
    }
};

/// Calls visit(ping, index) for each ping of the mission.
template <class Visit>
void for_each_ping(const Layout& layout, std::size_t poses, Visit visit) {
    std::uint64_t index = 0;
    for (std::uint32_t pose = 0; pose < poses; ++pose) {
        for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
            if (pose % layout.sensors[i].every == 0) visit(PingId{pose, i}, index++);
        }
    }
}

}  // namespace

void write_coco(const Layout& layout, const Json& description,
                std::span<const SharedProduct> products,
                const std::vector<SplitPart>& part_of_pose) {
    if (products.empty()) return;
    std::vector<OpenCoco> all;
    for (const SharedProduct& product : products) {
        std::vector<std::optional<PictureSeries>> series;
        for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
            series.push_back(
                series_of(layout.sensors[i], description.at("sensors").at(i), product.picture));
        }
        all.push_back({product, std::move(series),
                       std::make_unique<CocoFile>(layout.folder / product.file, description)});
        all.back().file->begin_list("images");
    }
    const ClassTable classes = class_table(description);
    for_each_ping(layout, part_of_pose.size(), [&](const PingId& ping, std::uint64_t index) {
        for (OpenCoco& one : all) {
            if (!one.lists(ping, part_of_pose)) continue;
            const PictureSeries& shown = *one.series[ping.sensor];
            one.file->add({{"id", one.image_id(index)},
                           {"file_name", place_of_file(layout, ping, shown.picture)},
                           {"width", shown.width},
                           {"height", shown.height},
                           {"sensor", layout.sensors[ping.sensor].name},
                           {"ping", ping.pose}});
        }
    });
    for (OpenCoco& one : all) {
        one.file->end_list();
        one.file->begin_list("annotations");
    }
    PingFileReader reader(layout);
    for_each_ping(layout, part_of_pose.size(), [&](const PingId& ping, std::uint64_t index) {
        Json objects;  // reading takes most of the time, so it is done once for all files
        for (OpenCoco& one : all) {
            if (!one.lists(ping, part_of_pose)) continue;
            const PictureSeries& shown = *one.series[ping.sensor];
            if (objects.is_null()) objects = Json::parse(reader.read(ping, shown.objects));
            for (const Json& object : objects.at("objects")) {
                if (const auto found = annotation_of(object, shown, one.product.picture,
                                                     one.image_id(index), classes))
                    one.file->add(annotation_json(*found));
            }
        }
    });
    for (OpenCoco& one : all) {
        one.file->end_list();
        one.file->finish();
    }
}

}  // namespace sonarsim
