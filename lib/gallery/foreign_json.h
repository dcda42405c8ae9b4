#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

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

}  // namespace sonarsim
