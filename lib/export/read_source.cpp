#include "export/read_source.h"

#include <algorithm>

#include "core/error.h"
#include "core/sha256.h"
#include "core/text.h"
#include "dataset/coco/reader.h"
#include "dataset/dataset_file.h"
#include "dataset/layout.h"
#include "export/cut.h"
#include "export/pictures.h"
#include "format/coco_counts.h"
#include "job/collection.h"
#include "job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A dataset in a folder, and the part to which all of it belongs.
struct Place {
    fs::path folder;
    std::string name;
    std::optional<SplitPart> part;
};

std::vector<Place> places_in(const fs::path& folder) {
    std::vector<Place> places;
    if (const std::optional<Json> json = read_variants(folder)) {
        const std::vector<fs::path> variants = folders_of_variants(folder, *json);
        const bool has_split = !split_lists(*json).empty();
        for (std::size_t i = 0; i < variants.size(); ++i) {
            Place& place = places.emplace_back(
                Place{variants[i], variants[i].filename().string(), std::nullopt});
            const std::string part = json->at("variants").at(i).value("split", "none");
            const auto found = std::ranges::find(split_part_names, part);
            if (has_split) place.part = static_cast<SplitPart>(found - split_part_names.begin());
        }
        return places;
    }
    for (const fs::path& dataset : collected_folders(folder))
        places.push_back({dataset, dataset.filename().string(), std::nullopt});
    if (places.empty()) places.push_back({folder, "", std::nullopt});
    return places;
}

SourceDataset describe_source(const Place& place, const ExportOptions& options) {
    const DatasetFile file = require_dataset(place.folder);
    const fs::path sums = place.folder / checksums_name;
    if (!file.complete || !fs::is_regular_file(sums)) {
        throw InputError({place.folder.string()},
                         "is not complete; the render command that made it, run again, goes on");
    }
    if (file.labels.classes.empty()) {
        throw InputError({place.folder.string()},
                         "has no label 'coco', from which objects are exported; set output.labels: "
                         "[coco] and render it again");
    }
    const std::string file_name = (place.folder / description_name).string();
    SourceDataset dataset{.folder = place.folder,
                          .name = place.name,
                          .description = {},
                          .classes = file.labels.classes,
                          .rules = annotation_rules({file.json.at("labels"), file_name}),
                          .coco_files = {},
                          .pictures = {}};
    dataset.description = {{"folder", place.name},
                           {"mission", file.mission},
                           {"mission_hash", file.mission_hash},
                           {"inputs_hash", file.inputs_hash},
                           {"seed", std::to_string(file.seed)},
                           {"program_version", file.json.at("program_version")},
                           {"sha256sums", sha256_of_file(sums)}};
    add_pictures(file, place.part, options, dataset);
    for (SourcePicture& picture : dataset.pictures) {
        picture.box = dataset.rules.config.box;
        picture.min_pixels = dataset.rules.config.min_pixels;
    }
    return dataset;
}

/// InputError for a given name that is not among the known ones.
void require_known(const std::vector<std::string>& given, const std::vector<std::string>& known,
                   const std::string& option) {
    for (const std::string& name : given) {
        if (std::ranges::find(known, name) != known.end()) continue;
        std::string all;
        for (const std::string& one : known)
            all += (all.empty() ? "" : ", ") + one;
        throw InputError(option + ": there is no '" + printable(name) + "'" +
                         did_you_mean(name, known) + "; there are: " + printable(all));
    }
}

Json json_of(const PixelBox& box) {
    return {box.left, box.top, box.right - box.left, box.bottom - box.top};
}

std::optional<double> number_or_none(const CheckedJson& annotation, const char* key) {
    const auto found = annotation.find(key);
    if (!found || found->json().is_null()) return std::nullopt;
    return found->number();
}

/// The facts of an object in an annotation; older versions have none.
SeenFacts facts_of(const CheckedJson& annotation, const SourcePicture& picture) {
    SeenFacts seen;
    seen.range_m = number_or_none(annotation, "range_m");
    seen.bearing_deg = number_or_none(annotation, "bearing_deg");
    seen.contrast_db = number_or_none(annotation, "contrast_db");
    seen.visible_share = number_or_none(annotation, "visible_share");
    seen.shadow_contrast_db = number_or_none(annotation, "shadow_contrast_db");
    if (const auto side = annotation.find("side"))
        seen.side = side->text() == "port" ? "port" : "starboard";
    const auto shadow = annotation.find("shadow_bbox");
    if (!shadow || shadow->json().is_null()) return seen;
    const std::vector<CheckedJson> numbers = shadow->items();
    if (numbers.size() != 4) shadow->refuse("left, top, width and height");
    const auto width = static_cast<std::uint64_t>(picture.width);
    const auto height = static_cast<std::uint64_t>(picture.height);
    const std::uint64_t left = numbers[0].whole(0, width - 1);
    const std::uint64_t top = numbers[1].whole(0, height - 1);
    seen.shadow =
        PixelBox{static_cast<int>(left), static_cast<int>(left + numbers[2].whole(1, width - left)),
                 static_cast<int>(top), static_cast<int>(top + numbers[3].whole(1, height - top))};
    return seen;
}

/// The mask of an annotation from its runs, which must agree with its area.
ObjectMask mask_of(const CheckedJson& annotation, const SourcePicture& picture) {
    const CheckedJson segmentation = annotation.at("segmentation");
    const CheckedJson counts = segmentation.at("counts");
    if (segmentation.at("size").json() != Json{picture.height, picture.width})
        segmentation.at("size").refuse("that of the picture");
    ObjectMask mask;
    const auto pixels =
        static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
    if (const auto runs = coco_runs(counts.text(), pixels))
        mask = mask_of_runs(*runs, picture.height);
    if (mask.area == 0) counts.refuse("compressed runs of the pixels of the picture");
    mask.id = static_cast<std::uint32_t>(annotation.at("instance_id").whole(1, 65535));
    return mask;
}

/// The object of an annotation, whose box must be that of its mask and shadow.
SourceObject object_of(const CheckedJson& annotation, const SourcePicture& picture,
                       int class_number) {
    SourceObject object;
    object.class_number = class_number;
    object.mask = mask_of(annotation, picture);
    object.is_crowd = annotation.at("iscrowd").whole(0, 1) == 1;
    object.seen = facts_of(annotation, picture);
    const std::optional<PixelBox> box =
        annotation_box(box_of(object.mask), object.seen.shadow, picture.box);
    if (!box || annotation.at("bbox").json() != json_of(*box))
        annotation.at("bbox").refuse(picture.box == LabelBox::object ? "the box of the mask"
                                                                     : "that of mask and shadow");
    object.box = *box;
    return object;
}

}  // namespace

ExportSource read_export_source(const fs::path& folder, const ExportOptions& options) {
    ExportSource source;
    std::vector<std::string> classes;    // all
    std::vector<std::string> annotated;  // classes that some dataset annotates
    std::vector<std::string> sensors;
    const auto add = [](std::vector<std::string>& names, const std::string& name) {
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    };
    for (const Place& place : places_in(folder)) {
        SourceDataset& dataset = source.datasets.emplace_back(describe_source(place, options));
        for (std::size_t k = 0; k < dataset.classes.size(); ++k) {
            add(classes, dataset.classes[k]);
            if (!dataset.rules.is_background(k)) add(annotated, dataset.classes[k]);
        }
        for (const DescribedSensor& sensor : require_dataset(place.folder).sensors)
            sensors.push_back(sensor.name);
    }
    std::ranges::sort(sensors);
    sensors.erase(std::unique(sensors.begin(), sensors.end()), sensors.end());
    require_known(options.sensors, sensors, "--sensor");
    require_known(options.without, classes, "--without");
    if (annotated.empty()) {
        throw InputError({folder.string()},
                         "annotates no class: each is background by labels.background of its "
                         "mission; [none] there annotates all");
    }
    for (const std::string& name : annotated) {
        const bool is_left_out = std::ranges::find(options.without, name) != options.without.end();
        if (!is_left_out) source.classes.push_back(name);
    }
    if (source.classes.empty()) throw InputError("--without: no class is left");
    const bool has_pictures = std::ranges::any_of(
        source.datasets, [](const SourceDataset& one) { return !one.pictures.empty(); });
    if (!has_pictures) {
        throw InputError({folder.string()},
                         "has no pictures to export: none of the sensors writes any");
    }
    return source;
}

std::map<std::uint64_t, std::vector<SourceObject>> read_source_objects(
    const ExportSource& source, const SourceDataset& dataset) {
    std::map<std::uint64_t, const SourcePicture*> pictures;
    for (const SourcePicture& picture : dataset.pictures)
        pictures[picture.id] = &picture;
    std::vector<int> numbers;
    for (const std::string& name : dataset.classes) {
        const auto found = std::ranges::find(source.classes, name);
        const bool is_object = found != source.classes.end();
        numbers.push_back(is_object ? static_cast<int>(found - source.classes.begin()) + 1 : 0);
    }
    std::map<std::uint64_t, std::vector<SourceObject>> objects;
    for (const std::string& file : dataset.coco_files) {
        read_coco(dataset.folder / file, "annotations", [&](const CheckedJson& annotation) {
            const std::uint64_t id = annotation.at("image_id").whole(1, most_image_id);
            const auto picture = pictures.find(id);
            if (picture == pictures.end()) return;  // another sensor shows it
            const std::uint64_t class_id = annotation.at("category_id").whole(1, numbers.size());
            objects[id].push_back(object_of(annotation, *picture->second, numbers[class_id - 1]));
        });
    }
    return objects;
}

}  // namespace sonarsim
