#include "dataset/shared_products.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "dataset/labelled_ping.h"
#include "dataset/seabed_files.h"
#include "mission/dataset_names.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

bool has_pictures(const Mission& mission, CocoPicture picture) {
    const OutputConfig& output = mission.output;
    if (picture == CocoPicture::record || picture == CocoPicture::scan) {
        const RecordPictures wanted =
            picture == CocoPicture::record ? RecordPictures::strip : RecordPictures::sweeps;
        return std::ranges::any_of(mission.sensors, [&](const SonarConfig& sensor) {
            const RecordShape& shape = kind_of(sensor.kind).record;
            return shape.pictures == wanted && shape.is_written(output);
        });
    }
    const bool written =
        picture == CocoPicture::fan ? output.has_fan() : output.image || output.has_polar();
    return written && std::ranges::any_of(mission.sensors, [](const SonarConfig& sensor) {
               return kind_of(sensor.kind).has_images;
           });
}

std::string part_name(SplitPart part) {
    return std::string(split_part_names[static_cast<std::size_t>(part)]);
}

void add_coco(const Mission& mission, CocoPicture picture, std::vector<SharedProduct>& products) {
    if (!has_pictures(mission, picture)) return;
    products.push_back({SharedProduct::Kind::coco, coco_file(picture), picture, SplitPart::none});
    const bool of_pings = picture == CocoPicture::polar || picture == CocoPicture::fan;
    if (!of_pings) return;
    for (const SplitPart part : parts_of(mission.output.split)) {
        products.push_back(
            {SharedProduct::Kind::coco, coco_file(picture, "_" + part_name(part)), picture, part});
    }
}

/// True for `labels: true`, which asks only for the labels that the sensors can have. A list asks
/// for each of its labels, so that one without a picture is an error.
bool asks_for_all(const Mission& mission) {
    return mission.output.labels.size() == static_cast<std::size_t>(Label::yolo_polygons) + 1;
}

}  // namespace

std::string coco_file(CocoPicture picture, const std::string& part) {
    const char* const stems[] = {"/coco", "/coco_fan", "/coco_records", "/coco_scans"};
    return labels_folder_name + std::string(stems[static_cast<std::size_t>(picture)]) + part +
           ".json";
}

std::vector<SharedProduct> shared_products(const Mission& mission) {
    std::vector<SharedProduct> products;
    for (const SplitPart part : parts_of(mission.output.split)) {
        products.push_back({SharedProduct::Kind::split, split_file_of(part_name(part)), {}, part});
    }
    if (is_asked(mission, Label::coco)) {
        add_coco(mission, CocoPicture::polar, products);
        add_coco(mission, CocoPicture::fan, products);
        add_coco(mission, CocoPicture::record, products);
        add_coco(mission, CocoPicture::scan, products);
        products.push_back({SharedProduct::Kind::statistics, statistics_name});
    }
    if (is_asked(mission, Label::yolo) || is_asked(mission, Label::yolo_polygons)) {
        products.push_back(
            {SharedProduct::Kind::class_names, labels_folder_name + std::string("/classes.txt")});
    }
    if (mission.scene.seabed) {
        for (std::string& file : seabed_file_names())
            products.push_back({SharedProduct::Kind::initial, std::move(file)});
    }
    if (mission.vehicle.navigation != NavigationConfig{})
        products.push_back({SharedProduct::Kind::initial, navigation_name});
    return products;
}

void check_shared_products(const Mission& mission, std::size_t poses) {
    if (mission.output.split.is_on()) split_poses(mission.output.split, poses);
    if (asks_for_all(mission)) return;
    struct Need {
        Label label;
        const char* name;
        bool met;
        const char* cure;
    };
    const bool polar = has_pictures(mission, CocoPicture::polar);
    const bool fan = has_pictures(mission, CocoPicture::fan);
    const bool imaging = std::ranges::any_of(
        mission.sensors, [](const SonarConfig& sensor) { return kind_of(sensor.kind).has_images; });
    const std::array needs{
        Need{Label::fan, "fan", fan, "output.fan: true"},
        Need{Label::semantic, "semantic", imaging, ""},
        Need{Label::coco, "coco",
             polar || fan || has_pictures(mission, CocoPicture::record) ||
                 has_pictures(mission, CocoPicture::scan),
             "output.image, polar or fan: true"},
        Need{Label::yolo, "yolo", imaging, ""},
        Need{Label::yolo_polygons, "yolo_polygons", imaging, ""},
    };
    for (const Need& need : needs) {
        if (need.met || !is_asked(mission, need.label)) continue;
        const std::string why =
            imaging ? std::string("it needs ") + need.cure
                    : "only imaging and profiling sonars have pictures of single pings, and the "
                      "mission has none of these; take it out of the list";
        throw InputError(
            mission.output.labels_place.location,
            std::string("the label '") + need.name + "' has no pictures to label: " + why);
    }
}

}  // namespace sonarsim
