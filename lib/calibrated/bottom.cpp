#include "calibrated/bottom.h"

#include "calibrated/decibel.h"
#include "core/units.h"

namespace sonarsim {

Backscatter backscatter(double lambert_db, double reflection, double slope_rms) {
    Backscatter out;
    out.lambert = static_cast<float>(power_of_db(lambert_db));
    if (slope_rms <= 0.0) return out;
    const double two_s2 = 2.0 * slope_rms * slope_rms;
    out.facet = static_cast<float>(reflection / (4.0 * pi * two_s2));
    out.inverse_slope2 = static_cast<float>(1.0 / two_s2);
    return out;
}

}  // namespace sonarsim
