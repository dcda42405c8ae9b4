#include "dataset/coco/file.h"

#include "core/error.h"
#include "format/coco_counts.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& item) {
    return item.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

CocoFile::CocoFile(const std::filesystem::path& path, const Json& description) : file_(path) {
    const Json info = {{"description", description.at("mission")},
                       {"version", description.at("program_version")}};
    file_.append("{\"info\": " + line_of(info) + ",\n\"licenses\": []");
    begin_list("categories");
    for (const Json& one : description.at("labels").at("classes")) {
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
    return {{"id", a.id},
            {"image_id", a.image_id},
            {"category_id", a.category},
            {"instance_id", a.instance},
            {"bbox", {a.left, a.top, a.width, a.height}},
            {"area", a.area},
            {"segmentation", {{"size", {a.image_height, a.image_width}}, {"counts", a.counts}}},
            {"iscrowd", 0}};
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

const PingRecord* instance_record(const SensorLayout& sensor) {
    for (const auto& part : sensor.per_ping) {
        const auto* record = std::get_if<PingRecord>(&part);
        if (record && record->label == "instance") return record;
    }
    return nullptr;
}

}  // namespace sonarsim
