#include "gallery/boxes.h"

#include <algorithm>
#include <cstdint>

#include "core/file.h"
#include "dataset/shared_products.h"

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

std::string object_text(const std::string& name, const std::string& class_name) {
    return name == class_name ? name : name + " (" + class_name + ")";
}

std::vector<std::string> object_texts(const Json& description) {
    std::vector<std::string> texts;
    if (!description.contains("labels")) return texts;
    const Json& labels = description["labels"];
    for (const Json& instance : labels.at("instances")) {
        const auto class_id = instance.at("class").get<std::size_t>();
        texts.push_back(
            object_text(instance.at("name"), labels.at("classes").at(class_id - 1).at("name")));
    }
    return texts;
}

std::size_t BoxLabels::index_of(const std::string& text) {
    const auto found = std::ranges::find(texts, text);
    if (found != texts.end()) return static_cast<std::size_t>(found - texts.begin());
    texts.push_back(text);
    return texts.size() - 1;
}

PictureBoxes picture_boxes(const fs::path& folder, const Json& description, BoxLabels& labels) {
    const std::vector<std::string> texts = object_texts(description);
    PictureBoxes boxes;
    for (const CocoPicture picture : {CocoPicture::record, CocoPicture::scan})
        add_boxes_of_file(folder / coco_file(picture), texts, labels, boxes);
    return boxes;
}

}  // namespace sonarsim
