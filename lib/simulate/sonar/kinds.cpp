#include "simulate/sonar/kinds.h"

#include <algorithm>
#include <stdexcept>

namespace sonarsim {

// Each is defined in the file of its name.
KindOfSonar imaging_kind();
KindOfSonar profiling_kind();
KindOfSonar sidescan_kind();
KindOfSonar echosounder_kind();
KindOfSonar scanning_kind();

const std::vector<KindOfSonar>& kinds_of_sonar() {
    static const std::vector<KindOfSonar> kinds = {
        imaging_kind(), profiling_kind(), sidescan_kind(), echosounder_kind(), scanning_kind(),
    };
    return kinds;
}

const KindOfSonar& kind_of(SonarKind kind) {
    const auto& kinds = kinds_of_sonar();
    const auto found = std::ranges::find_if(
        kinds, [kind](const KindOfSonar& one) { return one.keys.kind == kind; });
    if (found == kinds.end()) throw std::logic_error("a kind of sonar is not in the table");
    return *found;
}

std::size_t RecordShape::values(const SonarConfig& config) const {
    return bins ? bins(config).size() : static_cast<std::size_t>(config.range_bins);
}

std::string_view name_of(SonarKind kind) {
    return kind_of(kind).keys.name;
}

SonarConfig default_sonar(SonarKind kind) {
    return kind_of(kind).keys.defaults;
}

SonarKeyTable sonar_keys() {
    static const std::vector<SonarKeys> keys = [] {
        std::vector<SonarKeys> all;
        for (const KindOfSonar& kind : kinds_of_sonar())
            all.push_back(kind.keys);
        return all;
    }();
    return keys;
}

}  // namespace sonarsim
