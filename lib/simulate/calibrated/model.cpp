#include "simulate/calibrated/model.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/clock.h"
#include "core/decibel.h"
#include "core/elementary.h"
#include "core/lanes.h"
#include "core/units.h"
#include "simulate/calibrated/beams/beamformer.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/equation/expected_echo.h"
#include "simulate/calibrated/equation/water.h"

namespace sonarsim {

namespace {

constexpr float max_depth_by_bin = 0.5F;
// One or two beams of the view are often a few per cent wider than one or two steps.
constexpr float max_sine_by_step = 1.1F;
// As a share of the half-power width, within which the pattern bends.
constexpr double max_by_width = 0.1;

constexpr double no_level_db = -300.0;  // docs/mission.md
constexpr double max_noise = 1e20;      // instrument_levels.h: echoes are at most 1e24

// In the order in which they enter an image.
constexpr std::array<std::string_view, 2> calibrated_terms{"speckle", "receiver_noise"};

/// The guard beams of a line array: from the view to the borders of `view_azimuth_deg`. They are as
/// wide as the view's beams or, if that is at least twice as wide, as a step of the array's sine
/// grid, which the array does not resolve.
GuardBeams guard_beams_of(const BeamConfig& beam, const View& view) {
    const double side_rad = 0.5 * (radians(beam.view_azimuth_deg) - view.azimuth_rad);
    const double bin_rad = view.azimuth_rad / view.beams;
    const double width_rad = radians(beam.width_deg);
    const LineArray array = line_array(width_rad, beam.side_lobe_db);
    const double array_step_rad = arcsin(sine_grid(array, {0.0}).step);
    // Beams that the array does not resolve are traced as one.
    int joined = 4.0 * bin_rad > widest_column_rad ? 2 : 4;
    while (joined > 1 && (view.beams % joined != 0 || joined * bin_rad > 4.0 / 3.0 * width_rad))
        joined /= 2;
    if (array_step_rad < 2.0 * bin_rad) {
        // Whole joined beams; rounding of degrees to radians must not cost one.
        const double count = std::floor(side_rad / (joined * bin_rad) + 1e-6);
        return {.count = joined * static_cast<int>(std::max(0.0, count)), .joined = joined};
    }
    if (side_rad <= 0.0) return {.joined = joined};
    const double count = std::max(1.0, std::floor(side_rad / array_step_rad));
    return {.count = static_cast<int>(count), .beam_rad = side_rad / count, .joined = joined};
}

/// The size of patches that are points to the beams and to the bins.
PointLimits point_limits(const BeamConfig& beam, const View& view, const Beams& beams) {
    const auto part = [](double width_deg) {
        return static_cast<float>(max_by_width * radians(width_deg));
    };
    const float depth_m = max_depth_by_bin * static_cast<float>(view.bin_m());
    const auto nearest_m = static_cast<float>(view.range_min_m - 2.0 * view.bin_m());
    if (const SineGrid* const sines = beams.sines())
        return {depth_m, max_sine_by_step * static_cast<float>(sines->step),
                part(beam.elevation_width_deg), nearest_m};
    if (beam.aperture == Aperture::head)
        return {depth_m, part(beam.width_deg), part(beam.elevation_width_deg), nearest_m};
    if (beam.aperture == Aperture::port_starboard)
        return {depth_m, part(beam.across_width_deg), part(beam.width_deg), nearest_m};
    return {depth_m, part(beam.width_deg), part(beam.width_deg), nearest_m};
}

/// A resolution cell, or less where the pattern of a transducer bends within it.
PointLimits target_cell(const BeamConfig& beam, double resolution_m) {
    const auto part = [](double width_deg) {
        return 0.25F * static_cast<float>(radians(width_deg));
    };
    const auto depth = static_cast<float>(resolution_m);
    const auto width = static_cast<float>(radians(beam.width_deg));
    if (beam.aperture == Aperture::port_starboard)
        return {depth, part(beam.across_width_deg), width};
    if (beam.aperture == Aperture::piston)
        return {depth, part(beam.width_deg), part(beam.width_deg)};
    return {depth, width, part(beam.elevation_width_deg)};
}

/// The noise power by range bin, to a multiple of 8: `noise`, and the converter's behind the gain.
std::vector<double> row_noises(const std::vector<float>& row_gain, double noise,
                               double converter_noise_db) {
    const double converter =
        converter_noise_db > no_level_db ? power_of_db(converter_noise_db) : 0.0;
    std::vector<double> out((row_gain.size() + lanes - 1) / lanes * lanes, noise);
    for (std::size_t i = 0; i < row_gain.size(); ++i) {
        const double gain = row_gain[i];
        if (gain > 0.0) out[i] = std::min(noise + converter / gain, max_noise);
    }
    return out;
}

/// Sets the properties of the model but for its guard beams.
void set_info(CalibratedModel& model, const View& view) {
    const ReceiverConfig& receiver = model.instrument.receiver;
    EchoModelInfo& info = model.info;
    info.random_terms = calibrated_terms;
    info.needs_scattered_paths = true;
    info.energies_add = true;
    info.map_strengths = MapStrengths::at_points;
    info.is_slow = true;
    const double grid_bytes = 2.0 * model.beams->columns() * model.equation.rows * sizeof(float);
    // Multipath has a grid of its own, sediment has two. Ranks of samples need the mean image.
    info.working_bytes = (1.0 + (model.instrument.below_bottom ? 2.0 : 0.0) +
                          (model.detected.changes() ? 1.0 : 0.0)) *
                         grid_bytes;
    info.multipath_bytes = grid_bytes;
    if (std::ranges::max(model.noise_values) > 0.0F) info.mean_noise = model.noise_values;
    info.echo_gain.assign(model.row_gain.begin(), model.row_gain.end());
    info.cell.range_bins = model.target_cell.depth_m / view.bin_m();
    if (const ConeBeams& cones = model.beams->cones; cones.exist())
        info.cell.beams = radians(model.instrument.beam.width_deg) / cones.mean_width();
    info.raw_bits = receiver.bits;
    const bool is_fan = model.instrument.beam.aperture == Aperture::line && !is_profile(view);
    // The 99 % quantile of the speckle of sand at half of the range, but at most full scale.
    if (is_fan) {
        info.white = std::min(
            1.0, speckle_p99 * power_of_db(model.levels.sand_db - model.levels.full_scale_db));
    }
}

std::optional<double> wind_over(const Scene& scene) {
    return scene.water_surface ? scene.water_surface->wind_m_s : std::nullopt;
}

}  // namespace

CalibratedModel calibrated_model(const InstrumentConfig& instrument, const WaterConfig& water,
                                 const View& view, const BeamSines& sines) {
    const double bin_m = view.bin_m();
    const double resolution_m =
        instrument.pulse.resolution_m > 0.0 ? instrument.pulse.resolution_m : bin_m;
    const double resolution_bins = resolution_m / bin_m;
    const double side_lobe_db = instrument.pulse.side_lobe_db;
    const BeamConfig& beam = instrument.beam;
    const ReceiverConfig& receiver = instrument.receiver;
    CalibratedModel model;
    model.instrument = instrument;
    model.amplitude_taps = range_taps(resolution_bins, side_lobe_db);
    model.power_taps = power_taps(model.amplitude_taps);
    const std::vector<float> noise_filter = noise_taps(resolution_bins, side_lobe_db);
    model.speckle = instrument.speckle.mode;
    model.sound_speed_m_s = water.sound_speed_m_s;
    model.water_density_kg_m3 = water.density_kg_m3;
    model.wavelength_m = water.sound_speed_m_s / instrument.frequency_hz;
    model.absorption_db_per_m = absorption_db_per_m(
        instrument.frequency_hz, {water.temperature_c, water.salinity_psu, water.depth_m});

    model.levels = instrument_levels(instrument, water, view);
    // Relative to the source level. Without noise there is no headroom.
    const bool has_noise = model.levels.noise_db > no_level_db;
    const double noise_db =
        has_noise ? model.levels.noise_db - model.levels.source_level_db : no_level_db;
    const double raised_db = float_headroom_db(noise_db);
    const double noise = has_noise ? power_of_db(noise_db + raised_db) : 0.0;
    model.row_gain = row_gains(receiver, model.levels, view, model.absorption_db_per_m, raised_db);
    const std::vector<double> row_noise =
        row_noises(model.row_gain, noise, receiver.converter_noise_db);
    for (std::size_t i = 0; i < model.row_gain.size(); ++i) {
        const auto power = static_cast<float>(row_noise[i]);
        model.noise_values.push_back(std::min(model.row_gain[i] * power, max_value));
        model.analog_noise_values.push_back(
            std::min(model.row_gain[i] * static_cast<float>(noise), max_value));
    }
    if (beam.aperture == Aperture::line) {
        model.beams =
            array_beams(beam, sines, range_bins(view), model.wavelength_m, row_noise, noise_filter);
        model.info.guard_beams = guard_beams_of(beam, view);
        model.info.beam_gain = edge_gains(receiver, sines.middles, view.azimuth_rad);
        const SineGrid& grid = *model.beams->sines();
        std::vector<double> columns(static_cast<std::size_t>(grid.columns));
        for (int c = 0; c < grid.columns; ++c)
            columns[c] = grid.first + c * grid.step;
        model.column_gain = edge_gains(receiver, columns, view.azimuth_rad);
    } else {
        model.beams = transducer_beams(beam, view, model.wavelength_m, row_noise, noise_filter);
    }
    model.limits = point_limits(beam, view, *model.beams);
    model.equation = {.range_min_m = static_cast<float>(view.range_min_m),
                      .bin_m = static_cast<float>(bin_m),
                      .rows = view.range_bins,
                      .loss_per_m = static_cast<float>(0.2 * ln_10 * model.absorption_db_per_m),
                      .ln_headroom = static_cast<float>(0.1 * ln_10 * raised_db),
                      .elevation = elevation_pattern(radians(beam.elevation_width_deg),
                                                     beam.elevation_side_lobe_db, beam.elements,
                                                     beam.lobe_floor_db)};
    View guarded = view;
    guarded.guards = model.info.guard_beams;
    model.water = water_column(water_of(water, instrument), instrument, guarded, *model.beams,
                               model.equation);
    model.cells = scatterer_cells(std::max(resolution_m, 0.5 * bin_m), radians(beam.width_deg),
                                  view.range_min_m, model.wavelength_m);
    model.target_cell = target_cell(beam, std::max(resolution_m, 0.5 * bin_m));
    model.reverberation = Reverberation(receiver, bin_m, water.sound_speed_m_s);
    model.detected = DetectedSample(receiver);
    set_info(model, view);
    return model;
}

void CalibratedModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    if (!is_prepared_for(context.scene))
        return prepared_for(context.scene)->form(traced, context, ping);
    Stopwatch watch;
    const ReceiverConfig& receiver = instrument.receiver;
    std::vector<float> mean;
    const bool is_drawn = instrument.speckle.mode != SpeckleMode::none;
    if (detected.changes() && context.terms.random > 0 && is_drawn)
        mean.resize(ping.intensity.size());
    form_look(*this, traced, context, mean, ping);
    const ImageRows rows{
        .range_min_m = context.view.range_min_m,
        .bin_m = context.view.bin_m(),
        .bin_s = 2.0 * context.view.bin_m() / sound_speed_m_s,
        .pulse_s = pulse_band(instrument.pulse, context.view.bin_m(), sound_speed_m_s).pulse_s,
        .rows = context.view.range_bins,
        .beams = context.view.beams,
        .noise = analog_noise_values};
    const bool is_received = context.terms.random > 1;
    if (is_received && is_drawn) {
        constexpr Stream leaks = stream_named("leaks");
        add_leaks(receiver, rows.beams,
                  speckle == SpeckleMode::scene ? context.draws.scene_key(leaks)
                                                : context.draws.received(leaks),
                  ping.intensity);
    } else if (is_received) {
        add_mean_leaks(receiver, rows.beams, ping.intensity);
    }
    if (!mean.empty()) {
        // The mean is that of the draws, for the same places of the scatterers.
        if (is_received) add_to_rows(std::span(noise_values).first(rows.rows), rows, mean);
        if (is_received) add_mean_leaks(receiver, rows.beams, mean);
        detected.apply(mean, ping.intensity);
    }
    // Faults belong to the receiver's noise, the last of the random terms.
    if (is_received) add_faults(receiver, rows, context.draws, ping.intensity);
    ping.seconds.accumulate = watch.lap();
}

bool CalibratedModel::is_prepared_for(const Scene& scene) const {
    return prepared_materials == scene.materials && prepared_wind_m_s == wind_over(scene);
}

std::shared_ptr<const CalibratedModel> CalibratedModel::prepared_for(const Scene& scene) const {
    const Water seawater{water_density_kg_m3, sound_speed_m_s};
    auto out = std::make_shared<CalibratedModel>(*this);
    out->prepared_materials = scene.materials;
    out->scattering = scattering_of(scene.materials, instrument.frequency_hz, seawater);
    out->texture = Texture(scene.materials, instrument.speckle.texture);
    out->info.wall_transmissions =
        two_way_transmissions(scene.materials, instrument.frequency_hz, seawater);
    out->sediment.reset();
    if (instrument.below_bottom) {
        out->sediment = sediment_scattering(scene.materials, instrument.frequency_hz, seawater,
                                            equation.bin_m, out->scattering);
    }
    out->prepared_wind_m_s = wind_over(scene);
    if (out->prepared_wind_m_s)
        append(wind_surface(*out->prepared_wind_m_s, instrument.frequency_hz), out->scattering);
    return out;
}

std::shared_ptr<const EchoModel> CalibratedModel::prepared(const Scene& scene) const {
    return prepared_for(scene);
}

EchoModel::SignalAndNoise CalibratedModel::signal_and_noise(float clean, float noisy,
                                                            int /*range_bin*/, int /*beam*/) const {
    return {clean, std::fabs(noisy - clean)};
}

void CalibratedModel::describe(nlohmann::ordered_json& sensor) const {
    const ReceiverConfig& receiver = instrument.receiver;
    const bool absolute = !is_relative_source(levels.source_level_db);
    // The gain is constant up to tvg_from_m.
    const std::string range = receiver.tvg_from_m > 0.0 ? "max(range_m, tvg_from_m)" : "range_m";
    sensor["instrument"] = {
        {"echo_level", "full_scale_db + 10 log10(polar) - tvg_log log10(" + range + ")" +
                           (receiver.tvg_absorption ? " - 2 absorption_db_per_m " + range : "")},
        {"echo_level_unit", absolute ? "dB re 1 uPa" : "dB re the source level, per uPa at 1 m"},
        {"source_level_db", levels.source_level_db},
        {"noise_db", levels.noise_db},
        {"full_scale_db", levels.full_scale_db},
        {"tvg_log", receiver.tvg_log},
        {"absorption_db_per_m", absorption_db_per_m},
        {"tvg_makes_up_for_absorption", receiver.tvg_absorption},
        {"sound_speed_m_s", sound_speed_m_s},
        {"wavelength_m", wavelength_m}};
    if (receiver.tvg_from_m > 0.0) sensor["instrument"]["tvg_from_m"] = receiver.tvg_from_m;
}

std::vector<std::uint16_t> CalibratedModel::raw(const Ping& ping) const {
    return companded(ping.intensity, instrument.receiver);
}

}  // namespace sonarsim
