#include "gallery/box_labels.h"

#include <algorithm>

namespace sonarsim {

using Json = nlohmann::ordered_json;

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

}  // namespace sonarsim
