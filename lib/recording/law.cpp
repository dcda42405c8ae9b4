#include "recording/law.h"

#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

double power_of(const RecordedLaw& law, double value) {
    const double share = value / (law.full_value > 0.0 ? law.full_value : 1.0);
    if (law.kind == RecordedLaw::Kind::decibel)
        return power(10.0, (share + law.offset - 1.0) * law.range_db / 10.0);
    if (!(value > 0.0)) return 0.0;
    const double whole = share + law.offset;
    if (law.kind == RecordedLaw::Kind::power) return whole;
    if (law.kind == RecordedLaw::Kind::amplitude) return whole * whole;
    if (law.exponent == 0.5) return whole * whole * whole * whole;
    return power(whole, 2.0 / law.exponent);
}

std::vector<float> powers_of(const RecordedLaw& law, std::span<const float> values) {
    // Instruments deliver few different values, so the law is inverted once for each.
    constexpr std::size_t known = 65536;
    std::vector<float> of_whole(known, -1.0F);
    std::vector<float> powers(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const float value = values[k];
        const bool is_whole =
            value >= 0.0F && value < static_cast<float>(known) && value == std::floor(value);
        if (!is_whole) {
            powers[k] = static_cast<float>(power_of(law, value));
            continue;
        }
        float& stored = of_whole[static_cast<std::size_t>(value)];
        if (stored < 0.0F) stored = static_cast<float>(power_of(law, value));
        powers[k] = stored;
    }
    return powers;
}

}  // namespace sonarsim
