#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sonarsim {

/// What the page calls an object, wherever it shows it: "drum_3 (drum)", or the name alone where
/// the class has the same.
std::string object_text(const std::string& name, const std::string& class_name);

/// object_text() of the instances that dataset.json lists, by id - 1.
std::vector<std::string> object_texts(const nlohmann::ordered_json& description);

/// The texts that boxes bear, each once.
struct BoxLabels {
    std::vector<std::string> texts;

    std::size_t index_of(const std::string& text);
};

}  // namespace sonarsim
