#include "gallery/label_statistics.h"

#include <optional>
#include <vector>

#include "checks/find_warnings.h"
#include "dataset/coco/statistics.h"

namespace sonarsim {

nlohmann::ordered_json label_statistics(const std::filesystem::path& folder) {
    const std::optional<DatasetStatistics> found = read_statistics(folder);
    if (!found) return nullptr;
    nlohmann::ordered_json json = {{"all", tally_json(found->all)}};
    json["files"] = nlohmann::ordered_json::object();
    for (const auto& [name, tally] : found->files)
        json["files"][name] = tally_json(tally);
    json["warnings"] = nlohmann::ordered_json::array();
    for (const Warning& warning : class_warnings(found->all))
        json["warnings"].push_back(sentence(warning));
    return json;
}

nlohmann::ordered_json statistics_axes_json() {
    nlohmann::ordered_json axes = nlohmann::ordered_json::array();
    for (const StatisticsAxis& axis : all_statistics_axes()) {
        axes.push_back({{"key", axis.key},
                        {"title", axis.title},
                        {"edges", std::vector<double>(axis.edges.begin(), axis.edges.end())}});
    }
    return axes;
}

}  // namespace sonarsim
