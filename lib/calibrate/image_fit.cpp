#include "calibrate/image_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/common_mode.h"
#include "calibrate/image_law.h"
#include "calibrated/decibel.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// An error of the law scales all levels below full scale, and the gain with them.
void widen_by_law(const LawFit& law, NoiseFit& noise) {
    const Bounded& scale = law.companding == Companding::log ? law.dynamic_range_db : law.gamma;
    const double share = scale.half_width() / scale.value;
    widen(noise.level_db, share * noise.level_db.value);
    const double near = noise.at(noise.used.front().range_m);
    const double far = noise.at(noise.used.back().range_m);
    const double decades =
        0.1 * db_of_power(noise.used.back().range_m / noise.used.front().range_m);
    widen(noise.tvg_log, share * (far - near) / decades);
}

void set_noise_law(ImageFit& fit) {
    if (!fit.noise) {
        fit.notes.emplace_back(
            "noise and gain: no rows show noise alone (without zeros, even over the beams, on one "
            "law "
            "of range); noise_db, full_scale_db and tvg_log are those of the start");
        return;
    }
    widen_by_law(fit.law, *fit.noise);
    ReceiverConfig& receiver = fit.config.receiver;
    receiver.tvg_log = fit.noise->tvg_log.value;
    receiver.tvg_absorption = true;
    fit.estimates.push_back({"receiver.tvg_log", fit.noise->tvg_log, ""});
    fit.notes.emplace_back(
        "tvg_log and the absorption of the water cannot be separated here: tvg_log is for the "
        "water "
        "of the start");
    receiver.tvg_from_m = fit.noise->tvg_from_m.value;
    if (receiver.tvg_from_m > 0.0)
        fit.estimates.push_back({"receiver.tvg_from_m", fit.noise->tvg_from_m, ""});
}

void fit_pulse_of(const PatchClasses& classes, ImageFit& fit) {
    const auto of_kind = [&](ReceivedKind kind) {
        return fit_pulse(classes.patches, chosen_patches(classes, fit), classes.places,
                         pulse_model(fit.config, kind));
    };
    fit.pulse_bins =
        of_kind(fit.pulse_of_echoes ? echo_kind(fit.config.speckle) : ReceivedKind::noise);
    if (fit.pulse_bins && !fit.noise) {
        // The even patches may be noise as well as echoes.
        const std::optional<Bounded> of_noise = of_kind(ReceivedKind::noise);
        fit.pulse_bins->low = std::min(fit.pulse_bins->low, of_noise->low);
        fit.pulse_bins->high = std::max(fit.pulse_bins->high, of_noise->high);
        fit.notes.emplace_back(
            "pulse.resolution_m: noise and echoes cannot be separated here, so the interval holds "
            "the pulses of both");
    }
    if (!fit.pulse_bins) {
        fit.notes.emplace_back(
            "pulse: neighbouring bins are not correlated, so it is shorter than a "
            "bin, and its length cannot be measured; that of the start is kept");
    }
}

void set_pulse(double step_m, ImageFit& fit) {
    if (!fit.pulse_bins) return;
    const Bounded& bins = *fit.pulse_bins;
    fit.config.pulse.resolution_m = step_m * bins.value;
    fit.estimates.push_back(
        {"pulse.resolution_m", {step_m * bins.value, step_m * bins.low, step_m * bins.high}, ""});
}

void fit_beams(const PatchClasses& classes, const std::vector<double>& sines, ImageFit& fit) {
    BeamConfig& beam = fit.config.beam;
    const std::vector<std::size_t>& chosen = chosen_patches(classes, fit);
    fit.array = fit_array(beam_correlations(classes.patches, chosen, !fit.pulse_of_echoes), sines,
                          fit.law.statistics);
    if (!fit.array) {
        fit.notes.emplace_back(
            "beams: too few places of even echoes; width and taper are those of the start");
        return;
    }
    beam.width_deg = fit.array->width_deg.value;
    fit.estimates.push_back({"beam.width_deg", fit.array->width_deg, ""});
    beam.side_lobe_db = fit.array->side_lobe_db.value;
    fit.estimates.push_back({"beam.side_lobe_db", fit.array->side_lobe_db, ""});
    if (!fit.array->taper_known) {
        fit.notes.emplace_back(
            "beam.width_deg and beam.side_lobe_db can hardly be separated here: the two belong "
            "together");
    }
    fit.notes.emplace_back(
        "beam.aberration_rad: noise and speckle do not depend on errors of phase; "
        "they are those of the start");
}

void set_texture(const Recording& recording, ImageFit& fit) {
    const TextureFit& texture = *fit.texture;
    SpeckleConfig& speckle = fit.config.speckle;
    const auto shape = [&](double share) {
        const double part = std::clamp(share, 0.001, 0.95);
        return inverse_trigamma(part / (1.0 - part) * fit.law.statistics.variance);
    };
    speckle.clutter_shape = shape(texture.share.value);
    speckle.clutter_m = texture.edge_m.value;
    fit.estimates.push_back(
        {"speckle.clutter_shape",
         {speckle.clutter_shape, shape(texture.share.high), shape(texture.share.low)},
         ""});
    fit.estimates.push_back({"speckle.clutter_m", texture.edge_m, ""});
    fit.notes.emplace_back(
        "speckle.clutter_shape and clutter_m are those of this bottom, not of the sonar");
    if (!recording.altitude_m) {
        fit.notes.emplace_back(
            "speckle.clutter_m: without altitude_m in the recording lengths on the ground are "
            "taken as slant ranges");
    }
}

/// Fits the texture of echoes, and their pulse without the texture.
void fit_texture_of(const Recording& recording, const PatchClasses& classes,
                    const std::vector<double>& sines, ImageFit& fit) {
    // If pulse and law are fitted to noise, the texture does not affect them.
    if (!fit.pulse_bins || !fit.noise || !fit.pulse_of_echoes) return;
    const BeamConfig& beam = fit.config.beam;
    std::array<double, patch_lags> of_beams{};
    if (sines.size() > patch_lags)
        of_beams = predicted_beam_correlations(
            line_array(radians(beam.width_deg), beam.side_lobe_db), sines, fit.law.statistics);
    const PulseModel model = pulse_model(fit.config, echo_kind(fit.config.speckle));
    fit.texture = fit_texture(echo_patches(classes, recording, of_beams), model);
    if (!fit.texture) return;
    fit.pulse_bins = fit.texture->pulse_bins;
    set_texture(recording, fit);
}

/// The patches that determine pulse and array, and their fit.
void fit_pulse_and_array(const Recording& recording, ImageFit& fit) {
    const PatchClasses classes = classified(recording, fit.law, fit.noise);
    fit.pulse_of_echoes = classes.noise.size() < least_noise_patches;
    if (chosen_patches(classes, fit).size() < least_noise_patches) {
        fit.notes.emplace_back("pulse and beams: too few patches of noise or of even echoes");
        return;
    }
    fit_pulse_of(classes, fit);
    const std::vector<double> sines = beam_sines(recording);
    if (sines.size() > patch_lags) fit_beams(classes, sines, fit);
    fit_texture_of(recording, classes, sines, fit);
    set_pulse(recording.range_step_m, fit);
}

/// Fits the levels to the noise, and the noise that all elements share. Pings show only differences
/// of levels, so noise_db is that of the start and full_scale_db is fitted.
void fit_levels(const Recording& recording, const StartInstrument& start, ImageFit& fit) {
    ReceiverConfig& receiver = fit.config.receiver;
    const double noise_db = start.levels.noise_db;
    fit.noise_re_full_scale_db = noise_db - start.levels.full_scale_db;
    if (!fit.noise) return;
    const Bounded& level = fit.noise->level_db;
    fit.noise_re_full_scale_db = level.value;
    receiver.noise_db = noise_db;
    receiver.full_scale_db = noise_db - level.value;
    fit.estimates.push_back({"receiver.full_scale_db",
                             {noise_db - level.value, noise_db - level.high, noise_db - level.low},
                             ""});
    fit.notes.emplace_back(
        "noise_db, full_scale_db and source_level_db cannot be separated here: the "
        "pings have their differences; noise_db and source_level_db are those of "
        "the start, and full_scale_db is fitted to them");
    fit.notes.emplace_back(
        "transmit level and strength of the bottom cannot be separated here: echoes "
        "have their sum");
    Bounded& shared = fit.noise->common_mode_db;
    const double width = fit.config.beam.width_deg;
    shared = common_mode(recording, fit.law, *fit.noise, fit.config.beam,
                         fit.array ? fit.array->width_deg : Bounded{width, width, width});
    if (shared.value > -50.0) {
        receiver.common_mode_db = noise_db + shared.value;
        fit.estimates.push_back(
            {"receiver.common_mode_db",
             {noise_db + shared.value, noise_db + shared.low, noise_db + shared.high},
             ""});
    } else if (receiver.common_mode_db > -300.0) {
        fit.notes.emplace_back(
            "receiver.common_mode_db: no noise straight ahead was seen; that of the "
            "start is kept");
    }
}

}  // namespace

ImageFit fit_image(const Recording& recording, const StartInstrument& start) {
    ImageFit fit;
    fit.config = start.config;
    fit_law_of_image(recording, start, fit);
    fit_pulse_and_array(recording, fit);
    set_law_of_image(recording, start, fit);
    set_noise_law(fit);
    fit_levels(recording, start, fit);
    fit.notes.emplace_back(
        "beam.elevation_width_deg and elevation_side_lobe_db are not estimated: they need surfaces "
        "of known strength");
    return fit;
}

}  // namespace sonarsim
