#include "calibrate/image_law.h"

#include <algorithm>
#include <cmath>

#include "calibrate/common_mode.h"
#include "calibrate/delivered_values.h"
#include "calibrate/looks_fit.h"
#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_patches_of_law = 24;
constexpr double most_offset = 0.3;

/// The places of noise patches, for a second fit of the law: noise is surely Rayleigh distributed,
/// but an even patch of echoes may hold a texture.
std::vector<bool> noise_places(const PatchClasses& classes) {
    std::vector<bool> out;
    if (classes.noise.size() < least_patches_of_law) return out;
    out.assign(static_cast<std::size_t>(classes.places), false);
    for (const std::size_t k : classes.noise)
        out[static_cast<std::size_t>(classes.patches[k].place)] = true;
    return out;
}

/// The places with hardly any values of 0. A patch must not be chosen by its own zeros.
std::vector<bool> whole_places(const PatchClasses& classes, const LawFit& law, double full_value) {
    const auto count = static_cast<std::size_t>(classes.places);
    std::vector<double> sums(count), counts(count);
    for (const PatchMoments& patch : classes.patches) {
        sums[static_cast<std::size_t>(patch.place)] += patch.mean;
        counts[static_cast<std::size_t>(patch.place)] += 1.0;
    }
    std::vector<bool> out(count);
    double patches = 0.0;
    for (std::size_t place = 0; place < count; ++place) {
        const double level = exponential(sums[place] / counts[place] - law.statistics.mean);
        out[place] = !law.cuts_off(level, full_value);
        patches += out[place] ? counts[place] : 0.0;
    }
    return patches < 2.0 * least_patches_of_law ? std::vector<bool>{} : out;
}

/// The offset of a power law: that of the start, unless the pings show one that differs by 3.3
/// standard errors, with places as units. Under a logarithmic law deviations do not grow with the
/// mean, so the fitted offset is far off.
std::optional<Bounded> chosen_offset(const Recording& recording, double of_start,
                                     const std::vector<bool>& places) {
    const double full_value = full_value_of(recording);
    std::optional<Bounded> seen = fit_offset(recording.pings, full_value, places);
    if (!seen) return {};
    const double error =
        fit_offset(recording.pings, full_value, places, OffsetUnits::places)->half_width() / 1.96;
    const bool is_one = seen->value > 0.0 && seen->value < most_offset &&
                        std::fabs(seen->value - of_start) > 3.3 * error;
    if (!is_one) seen->value = of_start;
    seen->low = std::min(std::max(seen->low, 0.0), seen->value);
    seen->high = std::max(seen->high, seen->value);
    return seen;
}

/// Noise has one shape at all levels; echoes with a texture or several samples do not. So if the
/// intervals of the two offsets do not overlap, the offset of noise is used, else that of all
/// patches, which is more accurate.
void prefer_offset_of_noise(const Recording& recording, const std::vector<bool>& places,
                            ImageFit& fit) {
    const std::optional<Bounded> of_noise =
        fit_offset(recording.pings, full_value_of(recording), places);
    if (!of_noise) return;
    const Bounded& of_all = *fit.offset;
    if (of_noise->low <= of_all.high && of_all.low <= of_noise->high) return;
    fit.offset = chosen_offset(recording, fit.config.receiver.offset, places);
}

/// The law for the statistics of the start, with its offset.
void fit_first_law(const Recording& recording, const ReceiverConfig& start,
                   const LogStatistics& statistics, ImageFit& fit) {
    const double full_value = full_value_of(recording);
    fit.offset = chosen_offset(recording, start.offset, {});
    const double offset = fit.offset ? fit.offset->value : start.offset;
    fit.law = fit_law(recording.pings, full_value, statistics, {}, offset);
    if (fit.law.companding != Companding::log) return;
    if (offset != start.offset)
        fit.law = fit_law(recording.pings, full_value, statistics, {}, start.offset);
    fit.offset.reset();
}

/// The noise, first with all beams, then without those that stand out straight ahead.
void find_noise(const Recording& recording, double absorption_db_per_m, ImageFit& fit) {
    fit.noise = fit_noise(noise_blocks(recording, fit.law), absorption_db_per_m);
    if (!fit.noise) return;
    const AheadBeams ahead = ahead_beams(recording, fit.law, *fit.noise);
    if (ahead.end == 0) return;
    fit.noise = fit_noise(noise_blocks(recording, fit.law, ahead), absorption_db_per_m);
    if (fit.noise) fit.noise->ahead = ahead;
}

/// The statistics of the values of noise or, with too little noise, of echoes. With several samples
/// they depend on the pulse, which is fitted to correlations, since no law changes these.
LogStatistics second_statistics(const Recording& recording, const PatchClasses& classes,
                                ImageFit& fit) {
    const bool of_noise = !fit.law_of_echoes;
    const int start = std::max(fit.config.receiver.looks, 1);
    if (fit.config.receiver.samples <= 1) {
        const int looks = fit_looks(skewness_of_noise(classes, fit.law), start, fit.notes);
        if (looks != start) {
            const auto n = static_cast<double>(looks);
            fit.estimates.push_back({"receiver.looks", {n, n, n}, ""});
            fit.config.receiver.looks = looks;
        }
        return log_statistics(looks);
    }
    const PulseModel model =
        pulse_model(fit.config, of_noise ? ReceivedKind::noise : echo_kind(fit.config.speckle));
    const std::vector<std::size_t>& chosen = of_noise ? classes.noise : classes.echoes;
    std::optional<Bounded> bins;
    if (chosen.size() >= least_noise_patches)
        bins = fit_pulse(classes.patches, chosen, classes.places, model);
    return model.statistics(bins ? bins->value
                                 : pulse_bins_of(fit.config.pulse, recording.range_step_m));
}

/// Without a fit of the noise, even patches may be noise as well as echoes. With several samples
/// the variances of the two differ, and the law is proportional to the root of the variance.
void widen_by_kind(const Recording& recording, ImageFit& fit) {
    if (fit.config.receiver.samples <= 1) return;
    const double bins = pulse_bins_of(fit.config.pulse, recording.range_step_m);
    const double of_noise = pulse_model(fit.config, ReceivedKind::noise).statistics(bins).variance;
    const double share = std::fabs(std::sqrt(of_noise / fit.law.statistics.variance) - 1.0);
    widen(fit.law.gamma, share * fit.law.gamma.value);
    widen(fit.law.dynamic_range_db, share * fit.law.dynamic_range_db.value);
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

void set_offset(ImageFit& fit) {
    if (fit.law.companding == Companding::log) {
        fit.notes.emplace_back(
            "receiver.offset: after a logarithm it is one with full_scale_db; that of the start is "
            "kept");
    } else if (!fit.offset) {
        fit.notes.emplace_back(
            "receiver.offset: patches of one level do not tell it; that of the start is kept");
    } else {
        fit.config.receiver.offset = fit.offset->value;
        fit.estimates.push_back({"receiver.offset", *fit.offset, ""});
        // A greater offset raises all values and lowers gamma.
        const double per_offset = fit.law.gamma.value / fit.law.mean_share;
        const Bounded statistical = fit.law.gamma;
        const auto both = [](double one, double other) {
            return std::sqrt(one * one + other * other);
        };
        Bounded& gamma = fit.law.gamma;
        gamma.low = gamma.value - both(statistical.value - statistical.low,
                                       per_offset * (fit.offset->high - fit.offset->value));
        gamma.high = gamma.value + both(statistical.high - statistical.value,
                                        per_offset * (fit.offset->value - fit.offset->low));
    }
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

}  // namespace

const std::vector<std::size_t>& chosen_patches(const PatchClasses& classes, const ImageFit& fit) {
    return fit.pulse_of_echoes ? classes.echoes : classes.noise;
}

void fit_law_of_image(const Recording& recording, const StartInstrument& start, ImageFit& fit) {
    const double full_value = full_value_of(recording);
    const ReceiverConfig& receiver = start.config.receiver;
    const double start_bins = pulse_bins_of(start.config.pulse, recording.range_step_m);
    fit_first_law(recording, receiver,
                  pulse_model(start.config, ReceivedKind::noise).statistics(start_bins), fit);
    const Bounded slope = fit.law.slope;
    find_noise(recording, start.absorption_db_per_m, fit);
    const PatchClasses classes = classified(recording, fit.law, fit.noise);
    std::vector<bool> places = noise_places(classes);
    fit.law_of_echoes = places.empty();
    const LogStatistics statistics = second_statistics(recording, classes, fit);
    if (fit.offset && !fit.law_of_echoes) prefer_offset_of_noise(recording, places, fit);
    if (fit.law_of_echoes && !fit.noise) places = whole_places(classes, fit.law, full_value);
    // The first law was fitted to all levels; noise may have only one.
    fit.law = fit_law(recording.pings, full_value, statistics, places,
                      fit.offset ? fit.offset->value : receiver.offset, fit.law.companding);
    fit.law.slope = slope;
    if (fit.law_of_echoes) widen_by_kind(recording, fit);
    find_noise(recording, start.absorption_db_per_m, fit);
    fit.notes.emplace_back(
        receiver.samples > 1
            ? "receiver.looks and receiver.samples: several samples and several looks look much "
              "alike; those of the start are kept"
            : "receiver.samples, receiver.looks and companding: the largest of several samples, "
              "several looks and a larger gamma look much alike. Samples are those of the start, "
              "looks show in the skewness of log powers alone");
}

void set_law_of_image(const Recording& recording, const StartInstrument& start, ImageFit& fit) {
    if (fit.texture && fit.law_of_echoes) {
        // The law attributed the variance of the texture to speckle.
        const double factor = std::sqrt(1.0 - std::min(fit.texture->share.value, 0.9));
        const double error = 0.5 * fit.texture->share.half_width() / (factor * factor);
        for (Bounded* const scale : {&fit.law.gamma, &fit.law.dynamic_range_db}) {
            const double by = scale == &fit.law.gamma ? factor : 1.0 / factor;
            *scale = {by * scale->value, by * scale->low, by * scale->high};
            widen(*scale, error * scale->value);
        }
        find_noise(recording, start.absorption_db_per_m, fit);
    }
    set_bits(recording, fit);
    set_offset(fit);
    set_law(fit);
}

}  // namespace sonarsim
