#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sonarsim {

/// The text that describes an image folder in Croissant.
struct CroissantInput {
    std::string name;
    std::string description;
    std::string licence;
    std::vector<std::string> classes;
    /// Folder of each part, and the SHA-256 of its metadata.jsonl.
    std::vector<std::pair<std::string, std::string>> parts;
};

/// The JSON-LD of Croissant 1.0 (MLCommons, http://mlcommons.org/croissant/1.0) of an image folder
/// as imagefolder.cpp writes it: the files of each part with the sum of metadata.jsonl, a record
/// set per part with a record per picture, and the names of the classes. Croissant also asks for
/// url, creator, datePublished and version. sonarsim does not know them; the publisher adds them.
nlohmann::ordered_json croissant_json(const CroissantInput& input);

}  // namespace sonarsim
