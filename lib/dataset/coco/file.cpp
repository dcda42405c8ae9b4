#include "dataset/coco/file.h"

#include <cmath>

#include "core/error.h"
#include "dataset/label_description.h"
#include "format/coco_counts.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& item) {
    return item.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Rounds a value to a multiple of 1 / `per_unit`; null for none.
Json rounded(const std::optional<double>& value, double per_unit) {
    if (!value) return nullptr;
    return std::round(*value * per_unit) / per_unit;
}

void add_facts(const SeenFacts& seen, Json& json) {
    constexpr double millimetres = 1e3;
    constexpr double hundredths = 1e2;
    constexpr double of_share = 1e4;
    json["range_m"] = rounded(seen.range_m, millimetres);
    json["bearing_deg"] = rounded(seen.bearing_deg, hundredths);
    if (seen.side) json["side"] = seen.side;
    json["contrast_db"] = rounded(seen.contrast_db, hundredths);
    json["visible_share"] = rounded(seen.visible_share, of_share);
    json["shadow_bbox"] = nullptr;
    if (const auto& box = seen.shadow) {
        json["shadow_bbox"] = {box->left, box->top, box->right - box->left, box->bottom - box->top};
    }
    json["shadow_contrast_db"] = rounded(seen.shadow_contrast_db, hundredths);
}

}  // namespace

CocoFile::CocoFile(const std::filesystem::path& path, const Json& description) : file_(path) {
    const Json info = {{"description", description.at("mission")},
                       {"version", description.at("program_version")}};
    file_.append("{\"info\": " + line_of(info) + ",\n\"licenses\": []");
    begin_list("categories");
    const std::string name = description_name;
    const AnnotationRules rules = annotation_rules({description.at("labels"), name});
    std::size_t index = 0;
    for (const Json& one : description.at("labels").at("classes")) {
        if (rules.is_background(index++)) continue;
        add({{"id", one.at("id")}, {"name", one.at("name")}, {"supercategory", "object"}});
    }
    end_list();
}

void CocoFile::begin_list(const char* key) {
    file_.append(std::string(",\n\"") + key + "\": [");
    first_ = true;
}

void CocoFile::add(const Json& item) {
    file_.append((first_ ? "\n" : ",\n") + line_of(item));
    first_ = false;
}

void CocoFile::end_list() {
    file_.append("\n]");
}

void CocoFile::finish() {
    file_.append("}\n");
    file_.finish();
}

Json annotation_json(const CocoAnnotation& a) {
    Json json = {
        {"id", a.id},
        {"image_id", a.image_id},
        {"category_id", a.category},
        {"instance_id", a.instance},
        {"bbox", {a.left, a.top, a.width, a.height}},
        {"area", a.area},
        {"segmentation", {{"size", {a.image_height, a.image_width}}, {"counts", a.counts}}},
        {"iscrowd", a.is_crowd ? 1 : 0}};
    add_facts(a.seen, json);
    return json;
}

bool apply_rules(const LabelConfig& rules, bool is_background, CocoAnnotation& a) {
    const SeenFacts& seen = a.seen;
    const Annotated annotated = is_annotated(
        {is_background, a.area, seen.visible_share, seen.contrast_db, seen.shadow_contrast_db},
        rules);
    const PixelBox object{static_cast<int>(a.left), static_cast<int>(a.left + a.width),
                          static_cast<int>(a.top), static_cast<int>(a.top + a.height)};
    const std::optional<PixelBox> box = annotation_box(object, seen.shadow, rules.box);
    if (annotated == Annotated::no || !box) return false;
    a.is_crowd = annotated == Annotated::as_crowd;
    a.left = box->left;
    a.top = box->top;
    a.width = box->right - box->left;
    a.height = box->bottom - box->top;
    return true;
}

CocoAnnotation mask_annotation(const ObjectMask& mask, std::uint64_t width, std::uint64_t height) {
    CocoAnnotation annotation;
    annotation.left = mask.left;
    annotation.top = mask.top;
    annotation.width = mask.right - mask.left;
    annotation.height = mask.bottom - mask.top;
    annotation.area = mask.area;
    annotation.image_width = width;
    annotation.image_height = height;
    annotation.counts = coco_counts(mask.runs);
    return annotation;
}

const Json* labelled_picture(const Json& sensor, const char* per) {
    if (!sensor.contains("pictures")) {
        throw InputError("dataset.json lists no pictures of sensor '" +
                         sensor.at("name").get<std::string>() +
                         "', since an older sonarsim wrote it; render the dataset again");
    }
    for (const Json& picture : sensor.at("pictures")) {
        if (picture.at("per") == per && picture.contains("boxes_of")) return &picture;
    }
    return nullptr;
}

const PingRecord* record_of_label(const SensorLayout& sensor, std::string_view label) {
    for (const auto& part : sensor.per_ping) {
        const auto* record = std::get_if<PingRecord>(&part);
        if (record && record->label == label) return record;
    }
    return nullptr;
}

}  // namespace sonarsim
