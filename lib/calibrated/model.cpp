#include "calibrated/model.h"

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"
#include "calibrated/water.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// On the tank the expected image is within 0.7 % of that of much smaller patches.
constexpr float most_depth_by_bin = 0.5F;
constexpr float most_sine_by_step = 1.0F;
// As a share of the half-power width: the pattern bends within it.
constexpr double most_by_width = 0.1;

constexpr double no_common_mode_db = -300.0;

/// The guard beams of a line array: whole beams, and rounding of degrees to radians must not cost
/// one.
int guard_beams_of(const BeamConfig& beam, const View& view) {
    const double half = 0.5 * view.azimuth_rad;
    const double outside = 0.5 * (radians(beam.view_azimuth_deg) / (2.0 * half) - 1.0);
    return static_cast<int>(std::max(0.0, std::floor(outside * view.beams + 1e-6)));
}

/// The size of patches that are points to the beams and to the bins.
PointLimits point_limits(const BeamConfig& beam, const View& view,
                         const std::variant<TransducerBeams, ArrayBeams>& beams) {
    PointLimits limits{.depth_m = most_depth_by_bin * static_cast<float>(view.bin_m())};
    const double width = radians(beam.width_deg);
    if (const auto* const fan = std::get_if<ArrayBeams>(&beams)) {
        limits.sine = most_sine_by_step * static_cast<float>(fan->amplitudes.grid().step);
        limits.elevation_sine =
            static_cast<float>(most_by_width * radians(beam.elevation_width_deg));
    } else if (beam.aperture == Aperture::head) {
        limits.sine = static_cast<float>(most_by_width * width);
        limits.elevation_sine =
            static_cast<float>(most_by_width * radians(beam.elevation_width_deg));
    } else if (beam.aperture == Aperture::sides) {
        limits.sine = static_cast<float>(most_by_width * radians(beam.across_width_deg));
        limits.elevation_sine = static_cast<float>(most_by_width * width);
    } else {
        limits.sine = static_cast<float>(most_by_width * width);
        limits.elevation_sine = limits.sine;
    }
    return limits;
}

}  // namespace

CalibratedModel calibrated_model(const InstrumentConfig& instrument, const WaterConfig& water,
                                 const View& view, const std::vector<double>& beam_sines) {
    const double bin_m = view.bin_m();
    const double resolution_m =
        instrument.pulse.resolution_m > 0.0 ? instrument.pulse.resolution_m : bin_m;
    const double resolution_bins = resolution_m / bin_m;
    const double side_lobe_db = instrument.pulse.side_lobe_db;
    const BeamConfig& beam = instrument.beam;
    const ReceiverConfig& receiver = instrument.receiver;
    CalibratedModel model;
    model.instrument = instrument;
    model.clutter = gamma_clutter(instrument.speckle.clutter_shape, instrument.speckle.clutter_m);
    model.amplitude_taps = range_taps(resolution_bins, side_lobe_db, false);
    model.power_taps = range_taps(resolution_bins, side_lobe_db, true);
    model.speckle = instrument.speckle.mode;
    model.sound_speed_m_s = water.sound_speed_m_s;
    model.wavelength_m = water.sound_speed_m_s / instrument.frequency_hz;
    model.absorption_db_per_m =
        absorption_db_per_m(instrument.frequency_hz,
                            {water.temperature_c, water.salinity_psu, water.depth_m, water.ph});

    const auto relative = [&](double db) { return power_of_db(db - instrument.source_level_db); };
    const double noise = relative(receiver.noise_db);
    const double common_mode =
        receiver.common_mode_db > no_common_mode_db ? relative(receiver.common_mode_db) : 0.0;
    if (beam.aperture == Aperture::line) {
        model.beams = array_beams(beam, beam_sines, noise, common_mode);
        model.guard = guard_beams_of(beam, view);
    } else {
        model.beams = transducer_beams(beam, view, model.wavelength_m, noise + common_mode);
    }
    model.limits = point_limits(beam, view, model.beams);
    model.equation = {.range_min_m = static_cast<float>(view.range_min_m),
                      .bin_m = static_cast<float>(bin_m),
                      .rows = view.range_bins,
                      .loss_per_m = static_cast<float>(0.2 * ln_10 * model.absorption_db_per_m),
                      .elevation = elevation_pattern(radians(beam.elevation_width_deg),
                                                     beam.elevation_side_lobe_db)};
    model.cells = scatterer_cells(instrument.speckle.per_cell, std::max(resolution_m, 0.5 * bin_m),
                                  radians(beam.width_deg), view.range_min_m, model.wavelength_m);
    for (int i = 0; i < view.range_bins; ++i) {
        const double range = std::max(view.range_min_m + (i + 0.5) * bin_m, receiver.tvg_from_m);
        const double tvg_db =
            receiver.tvg_log / 10.0 * db_of_power(range) +
            (receiver.tvg_absorption ? 2.0 * model.absorption_db_per_m * range : 0.0);
        model.row_gain.push_back(static_cast<float>(
            power_of_db(instrument.source_level_db + tvg_db - receiver.full_scale_db)));
    }
    return model;
}

}  // namespace sonarsim
