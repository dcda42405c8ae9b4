#include "gallery/boxes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "dataset/coco/reader.h"
#include "dataset/shared_products.h"
#include "format/coco_counts.h"
#include "gallery/numbers.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_size_px = 1U << 20;
constexpr std::uint64_t largest_id = std::uint64_t{1} << 52;

/// Keys that are no details, since the box itself has them.
constexpr std::array<std::string_view, 6> known_keys{"id",   "image_id", "category_id",
                                                     "ping", "class",    "instance_id"};

bool is_box(const Json& value) {
    return value.is_array() && value.size() == 4 &&
           std::ranges::all_of(value, [](const Json& number) { return number.is_number(); });
}

Json box_of(const CheckedJson& annotation, const ListedBoxes& picture, const BoxLabels& labels) {
    Json box = {labels.of_instance(annotation.at("instance_id").whole(1, labels.instances))};
    const CheckedJson corners = annotation.at("bbox");
    for (const CheckedJson& number : corners.items()) {
        number.number();  // throws unless it is one
        box.push_back(number.json());
    }
    if (box.size() != 5) corners.refuse("four numbers");
    box.push_back(details_of(annotation, annotation.at("segmentation").at("counts"), picture.width,
                             picture.height));
    return box;
}

/// Adds the boxes of a COCO file to the pictures that it lists. `place(image)` makes the place of a
/// picture.
template <class Place>
void add_file(const fs::path& file, const BoxLabels& labels, const Place& place) {
    if (!fs::is_regular_file(file)) return;
    std::map<std::uint64_t, ListedBoxes*> by_id;
    read_coco(file, "images", [&](const CheckedJson& image) {
        ListedBoxes& own = place(image);
        own.width = image.at("width").whole(1, largest_size_px);
        own.height = image.at("height").whole(1, largest_size_px);
        by_id[image.at("id").whole(1, largest_id)] = &own;
    });
    read_coco(file, "annotations", [&](const CheckedJson& annotation) {
        const auto picture = by_id.find(annotation.at("image_id").whole(1, largest_id));
        if (picture == by_id.end()) annotation.at("image_id").refuse("the id of an image above");
        picture->second->boxes.push_back(box_of(annotation, *picture->second, labels));
    });
}

}  // namespace

BoxLabels::BoxLabels(const DatasetFile& dataset)
    : instances(dataset.labels.instances.size()), classes(dataset.labels.classes.size()) {}

std::size_t BoxLabels::of_instance(std::uint64_t id) const {
    if (id == 0 || id > instances) throw std::out_of_range("no such instance");
    return id - 1;
}

std::size_t BoxLabels::of_class(std::uint64_t class_index) const {
    if (class_index >= classes) throw std::out_of_range("no such class");
    return instances + class_index;
}

Json details_of(const CheckedJson& annotation, const std::optional<CheckedJson>& mask,
                std::uint64_t width, std::uint64_t height) {
    Json details = Json::object();
    if (mask) {
        if (!coco_runs(mask->text(), width * height))
            mask->refuse("compressed runs of the pixels of the picture");
        details["mask"] = mask->text();
    }
    for (const auto& [key, value] : annotation.json().items()) {
        const bool is_side = key == "side" && value.is_string();
        if (is_side || (key == "shadow_bbox" && is_box(value))) details[key] = value;
        if (!value.is_number() || std::ranges::find(known_keys, key) != known_keys.end()) continue;
        if (key == "iscrowd" && value == 0) continue;
        details[key] = short_number(value.get<double>());
    }
    return details;
}

CocoBoxes coco_boxes(const fs::path& folder, const BoxLabels& labels) {
    CocoBoxes all;
    for (const CocoPicture picture : {CocoPicture::record, CocoPicture::scan}) {
        add_file(folder / coco_file(picture), labels,
                 [&](const CheckedJson& image) -> ListedBoxes& {
                     return all.of_file[image.at("file_name").text()];
                 });
    }
    const auto of_pings = [](CocoBoxes::OfPings& pings) {
        return [&pings](const CheckedJson& image) -> ListedBoxes& {
            return pings[{image.at("sensor").text(), image.at("ping").whole(0, largest_id)}];
        };
    };
    add_file(folder / coco_file(CocoPicture::polar), labels, of_pings(all.in_image));
    add_file(folder / coco_file(CocoPicture::fan), labels, of_pings(all.in_fan));
    return all;
}

}  // namespace sonarsim
