#include <algorithm>
#include <string>
#include <vector>

#include "checks/find_warnings.h"
#include "core/text.h"

namespace sonarsim {

std::vector<Warning> class_warnings(const PictureTally& tally) {
    constexpr std::uint64_t few_pictures = 10;
    constexpr std::uint64_t one_in = 10;
    constexpr std::size_t most_names = 5;  // a scene may have a class for each of its nodes
    if (tally.pictures == 0) return {};
    std::vector<const ClassTally*> rare;
    for (const ClassTally& one : tally.classes) {
        if (one.pictures <= few_pictures && one.pictures * one_in <= tally.pictures)
            rare.push_back(&one);
    }
    if (rare.empty()) return {};
    std::string names;
    for (std::size_t k = 0; k < std::min(rare.size(), most_names); ++k) {
        names += (k == 0 ? "'" : ", '") + printable(rare[k]->name) + "' (" +
                 std::to_string(rare[k]->pictures) + ")";
    }
    if (rare.size() > most_names)
        names += " and " + std::to_string(rare.size() - most_names) + " classes more";
    return {make_warning(WarningCode::rare_class, "labels", tally.pictures, names)};
}

}  // namespace sonarsim
