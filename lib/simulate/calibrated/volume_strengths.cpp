#include "simulate/calibrated/volume_strengths.h"

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/decibel.h"

namespace sonarsim {

namespace {

/// A value of the key `content`.
struct Content {
    double strength = 0.0;  ///< m^2 per m^3
    double suspended_mg_l = 0.0;
};

Content content_of(WaterContent content) {
    switch (content) {
        case WaterContent::clear:
            return {power_of_db(-90.0), 0.5};
        case WaterContent::coastal:
            return {power_of_db(-75.0), 20.0};
        case WaterContent::plankton:
            return {power_of_db(-65.0), 20.0};
        case WaterContent::plume:
            return {power_of_db(-55.0), 0.0};
        case WaterContent::automatic:
        case WaterContent::none:
            break;
    }
    return {};
}

double bell(double x) {
    return exponential(-x * x);
}

/// |f| of sand by x = k a.
double form_function(double x) {
    const double dip = 1.0 - 0.35 * bell((x - 1.5) / 0.7);
    const double rise = 1.0 + 0.5 * bell((x - 1.8) / 2.2);
    return dip * rise * x * x / (1.0 + 0.9 * x * x);
}

}  // namespace

WaterConfig water_of(const WaterConfig& water, const InstrumentConfig& instrument) {
    WaterConfig out = water;
    if (out.content == WaterContent::automatic) out.content = instrument.usual_water;
    return out;
}

double suspended_strength(double mg_per_l, double diameter_um, double wavenumber) {
    constexpr double quartz_kg_m3 = 2650.0;
    const double radius_m = 0.5e-6 * diameter_um;
    const double form = form_function(wavenumber * radius_m);
    const double kg_m3 = 1e-3 * mg_per_l;
    return 3.0 * kg_m3 * form * form / (16.0 * pi * quartz_kg_m3 * radius_m);
}

double volume_strength(const WaterConfig& water, double frequency_hz) {
    Content content = content_of(water.content);
    // A given level includes the suspended particles that are usual for `content`.
    if (water.scattering_db_per_m3) content = {power_of_db(*water.scattering_db_per_m3), 0.0};
    const double wavenumber = 2.0 * pi * frequency_hz / water.sound_speed_m_s;
    constexpr double grain_um = 50.0;  // diameter of silt
    return content.strength + suspended_strength(content.suspended_mg_l, grain_um, wavenumber);
}

}  // namespace sonarsim
