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
    SourceDataset dataset{place.folder, place.name, {}, file.labels.classes, {}, {}};
    dataset.told = {{"folder", place.name},
                    {"mission", file.mission},
                    {"mission_hash", file.mission_hash},
                    {"inputs_hash", file.inputs_hash},
                    {"seed", std::to_string(file.seed)},
                    {"program_version", file.json.at("program_version")},
                    {"sha256sums", sha256_of_file(sums)}};
    add_pictures(file, place.part, options, dataset);
    return dataset;
}

/// InputError when a name that the user gave is none of those that there are.
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

/// The mask of an annotation from its runs, which must agree with its box and area.
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
    const Json box{mask.left, mask.top, mask.right - mask.left, mask.bottom - mask.top};
    if (annotation.at("bbox").json() != box) annotation.at("bbox").refuse("the box of the mask");
    mask.id = static_cast<std::uint32_t>(annotation.at("instance_id").whole(1, 65535));
    return mask;
}

}  // namespace

ExportSource read_export_source(const fs::path& folder, const ExportOptions& options) {
    ExportSource source;
    std::vector<std::string> classes;
    std::vector<std::string> sensors;
    for (const Place& place : places_in(folder)) {
        SourceDataset& dataset = source.datasets.emplace_back(describe_source(place, options));
        for (const std::string& name : dataset.classes) {
            if (std::ranges::find(classes, name) == classes.end()) classes.push_back(name);
        }
        for (const DescribedSensor& sensor : require_dataset(place.folder).sensors)
            sensors.push_back(sensor.name);
    }
    std::ranges::sort(sensors);
    sensors.erase(std::unique(sensors.begin(), sensors.end()), sensors.end());
    require_known(options.sensors, sensors, "--sensor");
    require_known(options.without, classes, "--without");
    for (const std::string& name : classes) {
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
            objects[id].push_back({numbers[class_id - 1], mask_of(annotation, *picture->second)});
        });
    }
    return objects;
}

}  // namespace sonarsim
