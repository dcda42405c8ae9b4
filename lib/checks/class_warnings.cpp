#include "checks/find_warnings.h"

namespace sonarsim {

std::vector<Warning> class_warnings(const PictureTally& tally) {
    constexpr std::uint64_t few_pictures = 10;
    constexpr std::uint64_t one_in = 10;
    std::vector<Warning> warnings;
    if (tally.pictures == 0) return warnings;
    for (const ClassTally& one : tally.classes) {
        const bool is_rare =
            one.pictures <= few_pictures && one.pictures * one_in <= tally.pictures;
        if (!is_rare) continue;
        warnings.push_back(make_warning(WarningCode::rare_class, "class '" + one.name + "'",
                                        one.pictures, tally.pictures));
    }
    return warnings;
}

}  // namespace sonarsim
