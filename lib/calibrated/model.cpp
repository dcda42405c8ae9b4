#include "calibrated/model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrated/decibel.h"
#include "calibrated/mirrored_echoes.h"
#include "calibrated/normals.h"
#include "calibrated/scatterer_search.h"
#include "calibrated/water.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// Pieces that a grid of bins and columns cannot tell from points. On the tank the expected image is
// within 0.7 % of that of much smaller ones. Where amplitudes are drawn anew, pieces of a whole
// bin, with 1.8 %, are small enough.
constexpr float most_depth_by_bin = 0.5F;
constexpr float most_drawn_depth_by_bin = 1.0F;
constexpr float most_sine_by_step = 1.0F;
// Of a half-power width: the pattern bends within it.
constexpr double most_by_width = 0.1;

constexpr double no_common_mode_db = -300.0;

std::vector<Backscatter> scattering_of(const Scene& scene) {
    std::vector<Backscatter> out;
    for (const Material& material : scene.materials) {
        const SinCos slope = sincos(radians(material.slope_rms_deg));
        out.push_back(backscatter(material.lambert_db, material.reflection, slope.sin / slope.cos));
    }
    return out;
}

/// Turns the powers of a grid into independent complex amplitudes, `gain` times as strong.
void draw_places(EchoGrid& grid, float gain, PhiloxKey key) {
    std::array<std::uint32_t, lanes_at_once> a, b;
    Lanes re, im;
    // Of variance 1 either part, so that the power of both is 2.
    const float half = 0.5F * gain;
    for (int c = 0; c < grid.columns(); ++c) {
        float* const values = grid.column(c);
        for (int row = 0; row < grid.rows(); row += lanes_at_once) {
            const int count = std::min(lanes_at_once, grid.rows() - row);
            float any = 0.0F;
            for (int lane = 0; lane < count; ++lane)
                any += values[std::ptrdiff_t{2} * (row + lane)];
            if (any == 0.0F) continue;
            for (int lane = 0; lane < lanes_at_once; ++lane) {
                a[lane] = static_cast<std::uint32_t>(row + lane);
                b[lane] = static_cast<std::uint32_t>(c);
            }
            philox_pairs(a.data(), b.data(), lanes_at_once, key);
            complex_normals(a.data(), re, im);
            for (int lane = 0; lane < count; ++lane) {
                float* const place = values + static_cast<std::ptrdiff_t>(2) * (row + lane);
                const float amplitude = std::sqrt(half * place[0]);
                place[0] = amplitude * re[lane];
                place[1] = amplitude * im[lane];
            }
        }
    }
}

void add_grid(const EchoGrid& more, EchoGrid& grid) {
    for (int c = 0; c < grid.columns(); ++c) {
        const float* const __restrict from = more.column(c);
        float* const __restrict to = grid.column(c);
        for (int i = 0; i < 2 * grid.rows(); ++i)
            to[i] += from[i];
    }
}

/// The image by beams of either kind.
template <class Beams>
CalibratedCounts form_image_of(const Beams& beams, const CalibratedModel& model,
                               const SeenSurface& seen, const Scene& scene,
                               const SonarInScene& sonar, const CalibratedDraws& draws,
                               const CalibratedTerms& terms, std::span<float> image) {
    const bool speckled = terms.speckle && model.speckle != SpeckleMode::none;
    const bool of_scene = speckled && model.speckle == SpeckleMode::scene;
    const std::vector<Backscatter> materials = scattering_of(scene);
    const std::array<std::span<const Sample>, 2> surfaces{seen.samples.items, seen.outside_sector};
    CalibratedCounts counts;
    EchoGrid grid(model.equation.rows, columns_of(beams));
    PointEchoes echoes;
    const auto find = [&](const PieceBlock& pieces) {
        counts.echoes += pieces.count;
        counts.out_of_range += find_echoes(pieces, materials, model.equation, echoes);
        counts.out_of_range += find_columns(beams, pieces, echoes);
        if (speckled) add_clutter(pieces, model.clutter, sonar, draws.scene, echoes);
    };
    if (terms.echoes && of_scene) {
        Scatterers block;
        Amplitudes amplitudes;
        for (const std::span<const Sample> surface : surfaces) {
            find_scatterers(
                surface, model.cells, sonar, draws.scene, block, [&](const Scatterers& found) {
                    find(found.pieces);
                    draw_amplitudes(found, echoes, model.cells, sonar, draws.scene, amplitudes);
                    add_amplitudes(beams, found.pieces, echoes, amplitudes, grid);
                });
        }
    } else if (terms.echoes) {
        PieceBlock block;
        PointLimits limits = model.limits;
        if (speckled) limits.depth_m *= most_drawn_depth_by_bin / most_depth_by_bin;
        for (const std::span<const Sample> surface : surfaces) {
            cut_into_pieces(surface, limits, block, [&](const PieceBlock& pieces) {
                find(pieces);
                add_powers(beams, pieces, echoes, grid);
            });
        }
    }

    // Independent places are fewer, but no less strong, than the points whose powers they hold.
    const float gain = model.amplitude_taps.fill * fill_of(beams);
    if (terms.mirrored && !seen.mirrored.empty()) {
        const auto add_to = [&](EchoGrid& powers) {
            counts.echoes += 2 * seen.mirrored.size();
            counts.out_of_range += add_mirrored_powers(beams, seen.mirrored, materials,
                                                       model.equation, model.limits, powers);
        };
        if (of_scene) {
            // By way of a mirror the phase follows its shape to a fraction of a wavelength, which
            // no mesh has: these amplitudes are drawn for the ping.
            EchoGrid mirrored(grid.rows(), grid.columns());
            add_to(mirrored);
            draw_places(mirrored, gain, draws.ping);
            add_grid(mirrored, grid);
        } else {
            add_to(grid);
        }
    }
    if (speckled && !of_scene) draw_places(grid, gain, draws.ping);
    counts.lit_places = grid.smear(speckled ? model.amplitude_taps : model.power_taps);
    receive(beams, grid, !speckled, terms.noise, draws.noise, model.row_gain, image);
    return counts;
}

/// The guard beams of a line array: whole beams, and rounding of degrees to radians must not cost
/// one.
int guard_beams_of(const BeamConfig& beam, const View& view) {
    const double half = 0.5 * view.azimuth_rad;
    const double outside = 0.5 * (radians(beam.view_azimuth_deg) / (2.0 * half) - 1.0);
    return static_cast<int>(std::max(0.0, std::floor(outside * view.beams + 1e-6)));
}

/// How small the pieces have to be, for beams of either kind, to be points to them.
PointLimits point_limits(const BeamConfig& beam, const View& view,
                         const std::variant<DirectedBeams, FanBeams>& beams) {
    PointLimits limits{.depth_m = most_depth_by_bin * static_cast<float>(view.bin_m())};
    const double width = radians(beam.width_deg);
    if (const auto* const fan = std::get_if<FanBeams>(&beams)) {
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
        model.beams = fan_beams(beam, beam_sines, noise, common_mode);
        model.guard = guard_beams_of(beam, view);
    } else {
        model.beams = directed_beams(beam, view, model.wavelength_m, noise + common_mode);
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

CalibratedCounts form_calibrated(const CalibratedModel& model, const SeenSurface& seen,
                                 const Scene& scene, const Pose& T_world_sensor,
                                 const CalibratedDraws& draws, const CalibratedTerms& terms,
                                 std::span<float> image) {
    const SonarInScene sonar{T_world_sensor.rotation.toRotationMatrix().cast<float>(),
                             T_world_sensor.translation - scene.origin};
    return std::visit(
        [&](const auto& beams) {
            return form_image_of(beams, model, seen, scene, sonar, draws, terms, image);
        },
        model.beams);
}

}  // namespace sonarsim
