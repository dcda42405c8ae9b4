#include "gallery/picture_boxes.h"

#include <cstdint>
#include <vector>

#include "core/file.h"
#include "gallery/foreign_json.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_coco = std::size_t{1} << 30;

void add_boxes_of_file(const fs::path& coco, const std::vector<std::string>& texts,
                       BoxLabels& labels, PictureBoxes& boxes) {
    if (!fs::is_regular_file(coco)) return;
    use_json(coco, read_file(coco, largest_coco), [&](const Json& all) {
        std::map<std::uint64_t, Json*> by_id;
        for (const Json& image : all.at("images")) {
            Json& own = boxes[image.at("file_name")];
            own = Json::array();
            by_id[image.at("id")] = &own;
        }
        for (const Json& annotation : all.at("annotations")) {
            const auto instance = annotation.at("instance_id").get<std::size_t>();
            Json box = {labels.index_of(texts.at(instance - 1))};
            for (const Json& number : annotation.at("bbox")) {
                number.get<double>();  // throws unless it is one
                box.push_back(number);
            }
            if (box.size() != 5) throw std::out_of_range("a box has four numbers");
            by_id.at(annotation.at("image_id"))->push_back(std::move(box));
        }
    });
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
