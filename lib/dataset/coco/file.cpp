#include "dataset/coco/file.h"

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

}  // namespace sonarsim
