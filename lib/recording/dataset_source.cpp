#include "recording/dataset_source.h"

#include <algorithm>

#include "dataset/file_names.h"

namespace sonarsim {

namespace fs = std::filesystem;

std::optional<std::string> pattern_of(const NamedTexts& patterns, const std::string& kind) {
    for (const auto& [name, pattern] : patterns) {
        if (name == kind) return pattern;
    }
    return std::nullopt;
}

void for_each_ping_array(
    const DatasetSource& source, const std::string& pattern,
    const std::function<void(std::size_t, const RecordedArray&, const std::string&)>& visit) {
    for (std::size_t k = 0; k < source.pings(); ++k) {
        const fs::path path = source.folder / numbered(pattern, k * source.sensor->every);
        visit(k, read_array_file(path), path.string());
    }
}

std::vector<double> middles(const CheckedJson& edges) {
    std::vector<double> out;
    const std::vector<CheckedJson> all = edges.items();
    for (std::size_t k = 0; k + 1 < all.size(); ++k)
        out.push_back(0.5 * (all[k].number() + all[k + 1].number()));
    return out;
}

}  // namespace sonarsim
