#include "gallery/members.h"

#include <optional>

#include "core/error.h"
#include "dataset/dataset_file.h"
#include "gallery/numbers.h"
#include "job/collection.h"
#include "job/variants.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Whole numbers keep all digits: as numbers JavaScript would round them beyond 2^53.
std::string fact_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return short_number(value.get<double>()).dump();
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json facts_of(const Json& variant) {
    Json facts = Json::object();
    if (variant.contains("split")) facts["part"] = fact_text(variant["split"]);
    const Json drawn = variant.value("drawn", Json::object());
    for (const auto& [key, value] : drawn.items())
        facts[key] = fact_text(value);
    return facts;
}

PageMembers members_of_variants(const fs::path& folder, const Json& json) {
    PageMembers all;
    all.name = json.contains("mission") ? fact_text(json["mission"]) : folder.filename().string();
    const std::vector<fs::path> folders = folders_of_variants(folder, json);
    for (std::size_t k = 0; k < folders.size(); ++k) {
        if (fs::exists(folders[k] / description_name)) {
            all.members.push_back(
                PageMember{folders[k].filename().string(), facts_of(json.at("variants").at(k))});
        } else {
            ++all.missing;
        }
    }
    if (all.members.empty()) {
        throw InputError({folder.string()},
                         "has no variant that is begun; the render command that made the folder, "
                         "run again, goes on");
    }
    return all;
}

}  // namespace

PageMembers page_members(const fs::path& folder) {
    if (const std::optional<Json> json = read_variants(folder))
        return members_of_variants(folder, *json);
    PageMembers all;
    for (const fs::path& dataset : collected_folders(folder))
        all.members.push_back(PageMember{dataset.filename().string(), Json::object()});
    if (!all.members.empty()) {
        all.name = fs::weakly_canonical(folder).filename().string();
        return all;
    }
    all.name = require_dataset(folder).mission;
    all.members.push_back(PageMember{"", Json::object()});
    return all;
}

}  // namespace sonarsim
