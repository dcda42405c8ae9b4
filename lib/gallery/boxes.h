#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.h"
#include "dataset/checked_json.h"

namespace sonarsim {

/// Hands the JSON of a file of a dataset to `use`. InputError with the file when it is no JSON, or
/// not what `use` expects of it.
template <class Use>
void use_json(const std::filesystem::path& file, const std::string& text, const Use& use) {
    try {
        use(parse_json(text, file.string()));
    } catch (const nlohmann::json::exception&) {
        throw InputError({file.string()}, "is not what sonarsim writes; run sonarsim verify");
    } catch (const std::out_of_range&) {
        throw InputError({file.string()},
                         "has ids that dataset.json does not; run sonarsim verify");
    }
}

/// The name of an object on the page: "drum_3 (drum)", or the name alone if its class has the same
/// name.
std::string object_text(const std::string& name, const std::string& class_name);

/// object_text() of the instances that dataset.json lists, by id - 1.
std::vector<std::string> object_texts(const nlohmann::ordered_json& description);

/// The texts of boxes, each once.
struct BoxLabels {
    std::vector<std::string> texts;

    std::size_t index_of(const std::string& text);
};

/// The boxes of labels in pictures of several pings, by the picture's path from the dataset's
/// folder. Each is a list of [label, x, y, width, height], px.
using PictureBoxes = std::map<std::string, nlohmann::ordered_json>;

/// The boxes of the COCO files of records and of sweeps; empty if the dataset has none.
PictureBoxes picture_boxes(const std::filesystem::path& folder,
                           const nlohmann::ordered_json& description, BoxLabels& labels);

}  // namespace sonarsim
