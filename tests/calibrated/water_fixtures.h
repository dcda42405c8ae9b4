#pragma once

#include "core/decibel.h"
#include "simulate/calibrated/signal/directivity.h"
#include "support/calibrated.h"

namespace sonarsim::test {

inline constexpr double strength_db = -60.0;

inline WaterConfig scattering_water() {
    WaterConfig water;
    water.scattering_db_per_m3 = strength_db;
    return water;
}

inline InstrumentConfig instrument_of(Aperture aperture, double width_deg,
                                      double resolution_m = 0.2) {
    InstrumentConfig config = bare({});
    config.frequency_hz = 2e5;
    config.beam.aperture = aperture;
    config.beam.width_deg = width_deg;
    config.pulse.resolution_m = resolution_m;
    return config;
}

/// 0.1 m bins from 2 to 22 m.
inline View view_of(ViewShape shape, double azimuth_deg, double elevation_deg, int beams) {
    return {radians(azimuth_deg), radians(elevation_deg), 2.0, 22.0, 200, beams, 0.03, shape};
}

/// The integral of the square of the compressed pulse over range: c tau / 2 of the text books. A
/// band with a taper has the pattern of an array with it, and by Parseval its integral is the mean
/// square of the weights over the length.
inline double pulse_length_m(const PulseConfig& pulse) {
    const LineArray band = line_array(1e-3, pulse.side_lobe_db);
    return taper_loss(band) / band.wavelengths * pulse.resolution_m / 1e-3;
}

/// S_v V / r^4 with V = r^2 Psi c tau / 2.
inline double expected_power(const CalibratedModel& model, double psi_sr, double range_m) {
    static const double length_m = pulse_length_m(instrument_of(Aperture::piston, 7.0).pulse);
    return power_of_db(strength_db - 2.0 * model.absorption_db_per_m * range_m) * psi_sr *
           length_m / (range_m * range_m);
}

/// The image of water without surface.
inline std::vector<float> water_image(const CalibratedModel& model, const View& view,
                                      const PingDraws& draws = {1, 2, 0}) {
    return image_of_traced(model, view, {}, {}, draws);
}

inline CalibratedModel sounder(SpeckleMode mode) {
    InstrumentConfig config = instrument_of(Aperture::piston, 7.0);
    config.speckle.mode = mode;
    return calibrated_model(config, scattering_water(), view_of(ViewShape::cone, 40.0, 40.0, 1),
                            {});
}

}  // namespace sonarsim::test
