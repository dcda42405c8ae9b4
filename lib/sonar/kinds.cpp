#include "sonar/kinds.h"

#include <algorithm>
#include <stdexcept>

namespace sonarsim {

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
