#pragma once

#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "simulate/calibrated/signal/line_array.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The scattering cross-section per unit of area and solid angle at a grazing angle with this sine.
double scattering_strength(const Material& sea_bed, double frequency_hz, double sine);

/// Bottoms by which instruments are judged, as in scenes/materials.csv: mud, sand and rock.
const std::array<Material, 3>& example_bottoms();

inline const Material& example_sand() {
    return example_bottoms()[1];
}

/// The mean echo of a flat bottom or of a small target, by closed form. The bottom
/// is seen at a grazing angle of 20 degrees on the axis of the beam, by an echosounder at normal
/// incidence. Levels are relative to the source level.
struct ExpectedEcho {
    Aperture aperture = Aperture::line;
    LineArray along;  ///< the array that resolves the bottom along a range bin
    double frequency_hz = 0.0;
    double wavelength_m = 0.0;
    double absorption_db_per_m = 0.0;
    double pulse_length_m = 0.0;  ///< PulseBand::length_m
    double grazing_rad = 0.0;
    double greatest_sine = 1.0;  ///< the sine along the array at which the view ends
    double far_integral = 0.0;   ///< the two-way pattern over the sine along the array
    double width_rad = 0.0, half_opening_rad = 0.0;  ///< the width of a disc, half its view
};

/// True for a fan so thin in elevation that it is a profiler, which stands upright.
bool is_profile(const View& view);

ExpectedEcho expected_echo(const InstrumentConfig& instrument, const WaterConfig& water,
                           const View& view);

/// The backscattering strength S of a bottom at the grazing angle, dB.
double bottom_strength_db(const ExpectedEcho& echo, const Material& material);

/// The mean echo of a bottom in a range bin: S + 10 log A - 40 log r - 2 alpha r.
double bottom_echo_db(const ExpectedEcho& echo, double strength_db, double range_m);

/// The echo of a target on the axis: TS - 40 log r - 2 alpha r, less the near field's loss.
double target_echo_db(const ExpectedEcho& echo, double target_strength_db, double range_m);

/// The farthest range with an echo of at least `level_db`, 0: none. `echo_db` falls with range.
template <class Function>
double range_of_level(const Function& echo_db, double level_db) {
    double low = 1e-3;
    double high = 1e6;
    if (echo_db(low) < level_db) return 0.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = std::sqrt(low * high);
        (echo_db(middle) >= level_db ? low : high) = middle;
    }
    return low;
}

}  // namespace sonarsim
