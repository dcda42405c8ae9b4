#include "gallery/picture_boxes.h"

#include <cstdint>
#include <vector>

#include "core/file.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_coco = std::size_t{1} << 30;

void add_boxes_of_file(const fs::path& coco, const std::vector<std::string>& texts,
                       BoxLabels& labels, PictureBoxes& boxes) {
    if (!fs::is_regular_file(coco)) return;
    const Json all = Json::parse(read_file(coco, largest_coco));
    std::map<std::uint64_t, Json*> by_id;
    for (const Json& image : all.at("images")) {
        Json& own = boxes[image.at("file_name")];
        own = Json::array();
        by_id[image.at("id")] = &own;
    }
    for (const Json& annotation : all.at("annotations")) {
        Json box = {labels.index_of(texts.at(annotation.at("instance_id").get<std::size_t>() - 1))};
        for (const Json& number : annotation.at("bbox"))
            box.push_back(number);
        by_id.at(annotation.at("image_id"))->push_back(std::move(box));
    }
}

}  // namespace

PictureBoxes picture_boxes(const fs::path& folder, const Json& description, BoxLabels& labels) {
    const std::vector<std::string> texts = object_texts(description);
    PictureBoxes boxes;
    for (const char* name : {"labels/coco_records.json", "labels/coco_scans.json"})
        add_boxes_of_file(folder / name, texts, labels, boxes);
    return boxes;
}

}  // namespace sonarsim
