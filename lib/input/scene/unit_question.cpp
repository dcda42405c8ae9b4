#include "input/scene/unit_question.h"

#include <spdlog/fmt/fmt.h>

namespace sonarsim {

std::string unit_question(double length_m, double unit_m, double range_m, double ranges) {
    constexpr double milli = 1e-3;
    if (unit_m == 1.0 && length_m > ranges * range_m && milli * length_m < range_m)
        return fmt::format("{:.4g} m long: millimetres? units: mm", length_m);
    if (unit_m == milli && length_m > 0.0 && length_m < milli * range_m)
        return fmt::format("{:.3g} m long: metres? units: m", length_m);
    return "";
}

}  // namespace sonarsim
