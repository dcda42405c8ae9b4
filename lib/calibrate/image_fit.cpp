#include "calibrate/image_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/delivered_values.h"
#include "calibrate/looks_fit.h"
#include "calibrated/decibel.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_noise_patches = 24;
constexpr std::size_t least_patches_of_law = 24;
constexpr double most_offset = 0.3;

/// The places of patches that are noise, for a second fit of the law: noise is Rayleigh's for sure,
/// and an even patch of echoes may still hold a texture.
std::vector<bool> noise_places(const PatchClasses& classes) {
    std::vector<bool> out;
    if (classes.noise.size() < least_patches_of_law) return out;
    out.assign(static_cast<std::size_t>(classes.places), false);
    for (const std::size_t k : classes.noise)
        out[static_cast<std::size_t>(classes.patches[k].place)] = true;
    return out;
}

void widen(Bounded& m, double by) {
    const double half = m.half_width();
    const double wider = std::sqrt(half * half + by * by) - half;
    m.low -= wider;
    m.high += wider;
}

/// The offset of a power law: that of the start, unless the pings have one that lies 3.3 standard
/// errors off it. Values of a logarithm have deviations that do not grow, so theirs is far off.
std::optional<Bounded> chosen_offset(const Recording& recording, double of_start) {
    std::optional<Bounded> seen = fit_offset(recording.pings, full_value_of(recording));
    if (!seen) return {};
    const double error = seen->half_width() / 1.96;
    const bool is_one = seen->value > 0.0 && seen->value < most_offset &&
                        std::fabs(seen->value - of_start) > 3.3 * error;
    if (!is_one) seen->value = of_start;
    seen->low = std::min(std::max(seen->low, 0.0), seen->value);
    seen->high = std::max(seen->high, seen->value);
    return seen;
}

/// The law for the number of looks of the start, with its offset.
void fit_first_law(const Recording& recording, const ReceiverConfig& start, ImageFit& fit) {
    const double full_value = full_value_of(recording);
    const int looks = std::max(start.looks, 1);
    const std::optional<Bounded> offset = chosen_offset(recording, start.offset);
    fit.law =
        fit_law(recording.pings, full_value, looks, {}, offset ? offset->value : start.offset);
    if (fit.law.companding == Companding::log) {
        if (fit.law.offset != start.offset)
            fit.law = fit_law(recording.pings, full_value, looks, {}, start.offset);
        fit.notes.emplace_back(
            "receiver.offset: after a logarithm it is one with full_scale_db; that of the start is "
            "kept");
        return;
    }
    if (!offset) {
        fit.notes.emplace_back(
            "receiver.offset: patches of one level do not tell it; that of the start is kept");
        return;
    }
    fit.offset = offset;
    fit.config.receiver.offset = offset->value;
    fit.estimates.push_back({"receiver.offset", *offset, ""});
}

void set_bits(const Recording& recording, ImageFit& fit) {
    const std::optional<int> bits = recording.law.full_value > 0.0
                                        ? bits_of(recording.pings, recording.law.full_value)
                                        : std::nullopt;
    if (!bits || *bits < 8 || *bits > 16) {
        fit.notes.emplace_back(
            "receiver.bits: the recording has no largest value of 8 to 16 bits, or its values are "
            "not whole steps of it; those of the start are kept");
        return;
    }
    fit.config.receiver.bits = *bits;
    const double number = *bits;
    fit.estimates.push_back({"receiver.bits", {number, number, number}, ""});
}

void fit_law_and_looks(const Recording& recording, const StartInstrument& start, ImageFit& fit) {
    const double full_value = full_value_of(recording);
    const int start_looks = std::max(start.config.receiver.looks, 1);
    fit_first_law(recording, start.config.receiver, fit);
    const Bounded slope = fit.law.slope;
    fit.noise = fit_noise(noise_blocks(recording, fit.law), start.absorption_db_per_m);
    const PatchClasses classes = classified(recording, fit.law, fit.noise);
    const std::vector<bool> places = noise_places(classes);
    const int looks = fit_looks(skewness_of_noise(classes, fit.law), start_looks, fit.notes);
    if (!places.empty() || looks != start_looks)
        fit.law = fit_law(recording.pings, full_value, looks, places, fit.law.offset);
    if (looks != start_looks) {
        const auto n = static_cast<double>(looks);
        fit.estimates.push_back({"receiver.looks", {n, n, n}, ""});
        fit.config.receiver.looks = looks;
    }
    if (fit.offset) {
        const double share = fit.offset->half_width() / fit.law.mean_share;
        widen(fit.law.gamma, fit.law.gamma.value * share);
    }
    fit.law.slope = slope;
    fit.noise = fit_noise(noise_blocks(recording, fit.law), start.absorption_db_per_m);
    fit.notes.emplace_back(
        "looks and companding are separated by the skewness of log powers alone: several looks "
        "with "
        "a larger gamma look much alike");
}

void set_law(ImageFit& fit) {
    ReceiverConfig& receiver = fit.config.receiver;
    if (fit.law.companding == Companding::log) {
        receiver.companding = Companding::log;
        receiver.dynamic_range_db = fit.law.dynamic_range_db.value;
        fit.estimates.push_back({"receiver.companding", {}, "log"});
        fit.estimates.push_back({"receiver.dynamic_range_db", fit.law.dynamic_range_db, ""});
        return;
    }
    receiver.companding = Companding::gamma;
    receiver.gamma = fit.law.gamma.value;
    fit.estimates.push_back({"receiver.companding", {}, "gamma"});
    fit.estimates.push_back({"receiver.gamma", fit.law.gamma, ""});
}

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

void fit_pulse_of(const Recording& recording, const PatchClasses& classes, ImageFit& fit) {
    PulseConfig& pulse = fit.config.pulse;
    const ReceivedKind kind =
        fit.pulse_of_echoes ? echo_kind(fit.config.speckle) : ReceivedKind::noise;
    const std::vector<std::size_t>& chosen = fit.pulse_of_echoes ? classes.echoes : classes.noise;
    if (fit.config.receiver.samples > 1) {
        fit.notes.emplace_back(
            "receiver.samples: the start makes one bin of several samples. The pulse is kept, and "
            "the law "
            "is that of one sample, so gamma comes out too small");
        return;
    }
    fit.pulse_bins =
        fit_pulse(classes.patches, chosen, classes.places, pulse.side_lobe_db, kind, fit.law.looks);
    if (!fit.pulse_bins) {
        fit.notes.emplace_back(
            "pulse: neighbouring bins are not correlated, so it is shorter than a "
            "bin, and its length cannot be measured; that of the start is kept");
        return;
    }
    const double step = recording.range_step_m;
    const Bounded& bins = *fit.pulse_bins;
    pulse.resolution_m = step * bins.value;
    fit.estimates.push_back(
        {"pulse.resolution_m", {step * bins.value, step * bins.low, step * bins.high}, ""});
}

void fit_beams(const PatchClasses& classes, const std::vector<double>& sines, ImageFit& fit) {
    BeamConfig& beam = fit.config.beam;
    const std::vector<std::size_t>& chosen = fit.pulse_of_echoes ? classes.echoes : classes.noise;
    fit.array = fit_array(beam_correlations(classes.patches, chosen, !fit.pulse_of_echoes), sines,
                          fit.law.looks);
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

/// The patches that tell pulse and array, and what they tell.
void fit_pulse_and_array(const Recording& recording, ImageFit& fit) {
    const PatchClasses classes = classified(recording, fit.law, fit.noise);
    fit.pulse_of_echoes = classes.noise.size() < least_noise_patches;
    const std::vector<std::size_t>& chosen = fit.pulse_of_echoes ? classes.echoes : classes.noise;
    if (chosen.size() < least_noise_patches) {
        fit.notes.emplace_back("pulse and beams: too few patches of noise or of even echoes");
        return;
    }
    fit_pulse_of(recording, classes, fit);
    const std::vector<double> sines = beam_sines(recording);
    if (sines.size() > patch_lags) fit_beams(classes, sines, fit);
}

/// Levels by the noise, and the noise that all elements share. Only differences of levels show, so
/// noise_db is that of the start and full_scale_db is fitted.
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
    shared = common_mode(recording, fit.law, *fit.noise, radians(fit.config.beam.width_deg));
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
    fit_law_and_looks(recording, start, fit);
    set_bits(recording, fit);
    set_law(fit);
    set_noise_law(fit);
    fit_pulse_and_array(recording, fit);
    fit_levels(recording, start, fit);
    if (start.config.receiver.samples == 1) {
        fit.notes.emplace_back(
            "receiver.samples is not estimated: the largest of several samples and several looks "
            "look much alike");
    }
    fit.notes.emplace_back(
        "beam.elevation_width_deg and elevation_side_lobe_db are not estimated: they need surfaces "
        "of known strength");
    return fit;
}

}  // namespace sonarsim
