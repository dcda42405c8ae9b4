#include "calibrate/judge.h"

#include <algorithm>
#include <cmath>

#include "calibrate/correlations.h"
#include "calibrate/texture_fit.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_patches_of_figure = 12;

/// The data that figures_of() works on.
struct Judged {
    const Recording& recording;
    const InstrumentConfig& instrument;
    LawFit law;      ///< the instrument's
    NoiseFit noise;  ///< the instrument's, with the rows of the fit
    PatchClasses classes;
    std::vector<Figure> figures;
};

NoiseFit stated_noise(const InstrumentConfig& instrument, double noise_re_full_scale_db,
                      double absorption_db_per_m, const std::optional<NoiseFit>& of_fit) {
    const ReceiverConfig& receiver = instrument.receiver;
    NoiseFit out;
    out.level_db.value = noise_re_full_scale_db;
    out.tvg_log.value = receiver.tvg_log;
    out.tvg_from_m.value = receiver.tvg_from_m;
    out.absorption_db_per_m = receiver.tvg_absorption ? absorption_db_per_m : 0.0;
    if (of_fit) {
        out.used = of_fit->used;
        out.ahead = of_fit->ahead;
    }
    return out;
}

void add(Judged& judged, const std::string& name, FitTolerance tolerance, double predicted,
         const std::function<double(const std::vector<double>&)>& measured) {
    Figure figure{name, tolerance, predicted, bootstrap(judged.classes.places, measured, 0.0, 40)};
    if (std::isfinite(figure.measured.value)) judged.figures.push_back(std::move(figure));
}

/// The weighted mean of a moment over chosen patches.
double mean_of(const std::vector<PatchMoments>& patches, const std::vector<std::size_t>& chosen,
               const std::vector<double>& weights, double PatchMoments::*moment) {
    double sum = 0.0, weight = 0.0;
    for (const std::size_t k : chosen) {
        const double w = weights[static_cast<std::size_t>(patches[k].place)];
        sum += w * patches[k].*moment;
        weight += w;
    }
    return sum / weight;
}

/// The variation of an amplitude with a texture: the mean squares of two independent factors
/// multiply.
double variation_with(const SpeckleConfig& speckle, const LogStatistics& statistics) {
    if (speckle.clutter_shape <= 0.0) return statistics.variation;
    const double of_texture = gamma_amplitude_variation(speckle.clutter_shape);
    return std::sqrt((1.0 + statistics.variation * statistics.variation) *
                         (1.0 + of_texture * of_texture) -
                     1.0);
}

void add_distribution(Judged& judged, const std::string& where,
                      const std::vector<std::size_t>& chosen, const LogStatistics& statistics,
                      const SpeckleConfig& speckle) {
    const double full_value = full_value_of(judged.recording);
    const LawFit& law = judged.law;
    const std::vector<PatchMoments> amplitudes =
        patch_moments(judged.recording.pings, full_value, [&](double v, int row) {
            const double range_m = range_of_row(judged.recording, row);
            const double gain = judged.noise.at(range_m) / db_of_e;
            return exponential(0.5 * (law.log_power(v, full_value) - gain));
        });
    const std::vector<PatchMoments>& logs = judged.classes.patches;
    add(judged, where + ": variation of the amplitude", FitTolerance::tenth,
        variation_with(speckle, statistics), [&](const std::vector<double>& w) {
            double sum = 0.0, weight = 0.0;
            for (const std::size_t k : chosen) {
                const PatchMoments& p = amplitudes[k];
                const double of_place = w[static_cast<std::size_t>(p.place)];
                sum += of_place * std::sqrt(p.variance) / p.mean;
                weight += of_place;
            }
            return sum / weight;
        });
    const double to_shape = 2.0 * pi / std::sqrt(6.0);
    add(judged, where + ": Weibull shape of the amplitude", FitTolerance::tenth,
        to_shape / std::sqrt(statistics.variance / (1.0 - texture_of(speckle, statistics).share)),
        [&](const std::vector<double>& w) {
            return to_shape / std::sqrt(mean_of(logs, chosen, w, &PatchMoments::variance));
        });
}

void add_correlations(Judged& judged, const std::string& where,
                      const std::vector<std::size_t>& chosen, const PulseModel& model,
                      const LogStatistics& statistics, const SpeckleConfig& speckle) {
    const BottomTexture texture = texture_of(speckle, statistics);
    const EchoPatches distances = echo_patches(judged.classes, judged.recording, {});
    const auto with_texture = [&](double of_speckle, double lag, double step_m) {
        return texture.correlation(of_speckle, lag * step_m);
    };
    const auto measured = [&](const std::vector<double>& w) {
        return correlations_of(judged.classes.patches, chosen, w);
    };
    const std::array<double, patch_lags> along_range =
        model.correlations(pulse_bins_of(judged.instrument.pulse, judged.recording.range_step_m));
    for (const std::size_t lag : {1U, 2U, 4U}) {
        add(judged, where + ": correlation " + std::to_string(lag) + " bins apart",
            FitTolerance::correlation,
            with_texture(along_range[lag - 1], lag, distances.range_step_m),
            [&](const std::vector<double>& w) { return measured(w).along_range[lag - 1]; });
    }
    const std::vector<double> sines = beam_sines(judged.recording);
    if (sines.size() <= patch_lags) return;
    const BeamConfig& beam = judged.instrument.beam;
    const std::array<double, patch_lags> along_beams = predicted_beam_correlations(
        line_array(radians(beam.width_deg), beam.side_lobe_db), sines, statistics);
    for (const std::size_t lag : {1U, 2U, 4U}) {
        add(judged, where + ": correlation " + std::to_string(lag) + " beams apart",
            FitTolerance::correlation,
            with_texture(along_beams[lag - 1], lag, distances.beam_step_m),
            [&](const std::vector<double>& w) { return measured(w).along_beams[lag - 1]; });
    }
}

/// The level of the noise in the nearest, middle and farthest third of its blocks.
void add_noise_levels(Judged& judged, const std::vector<NoiseBlock>& measured) {
    const std::vector<NoiseBlock>& rows = judged.noise.used;
    const char* const names[] = {"near", "middle", "far"};
    for (std::size_t third = 0; third < 3; ++third) {
        std::vector<double> levels;
        double predicted = 0.0;
        for (std::size_t k = third * rows.size() / 3; k < (third + 1) * rows.size() / 3; ++k) {
            const auto same = [&](const NoiseBlock& block) { return block.row == rows[k].row; };
            const auto at = std::find_if(measured.begin(), measured.end(), same);
            // A single ping does not show the noise below a constant echo.
            if (at == measured.end() || !rows[k].without_echo) continue;
            levels.push_back(at->level_db);
            predicted += judged.noise.at(at->range_m);
        }
        if (levels.empty()) continue;
        const auto count = static_cast<double>(levels.size());
        const auto mean = [&](const std::vector<double>& weights) {
            double sum = 0.0, weight = 0.0;
            for (std::size_t k = 0; k < levels.size(); ++k) {
                sum += weights[k] * levels[k];
                weight += weights[k];
            }
            return sum / weight;
        };
        judged.figures.push_back(
            {std::string("noise: level by full scale, ") + names[third] + ", dB",
             FitTolerance::decibel, predicted / count,
             bootstrap(static_cast<int>(levels.size()), mean)});
    }
}

}  // namespace

bool Figure::agrees() const {
    const double off = std::fabs(predicted - measured.value);
    if (tolerance == FitTolerance::decibel) return off <= 1.0;
    if (tolerance == FitTolerance::correlation) return off <= 0.05;
    const double share = tolerance == FitTolerance::tenth ? 0.1 : 0.15;
    return off <= share * std::fabs(measured.value);
}

std::vector<Figure> figures_of(const Recording& recording, const InstrumentConfig& instrument,
                               double noise_re_full_scale_db, double absorption_db_per_m,
                               const std::optional<NoiseFit>& of_fit) {
    const double bins = pulse_bins_of(instrument.pulse, recording.range_step_m);
    const PulseModel of_noise = pulse_model(instrument, ReceivedKind::noise);
    Judged judged{recording,
                  instrument,
                  stated_law(instrument.receiver, of_noise.statistics(bins)),
                  stated_noise(instrument, noise_re_full_scale_db, absorption_db_per_m, of_fit),
                  {},
                  {}};
    judged.classes = classified(recording, judged.law, judged.noise);
    const auto add_class = [&](const std::string& name, const std::vector<std::size_t>& chosen,
                               const PulseModel& model, const SpeckleConfig& speckle) {
        if (chosen.size() < least_patches_of_figure) return;
        const LogStatistics statistics = model.statistics(bins);
        add_distribution(judged, name, chosen, statistics, speckle);
        add_correlations(judged, name, chosen, model, statistics, speckle);
    };
    add_class("noise", judged.classes.noise, of_noise, {});
    if (judged.classes.noise.size() >= least_patches_of_figure)
        add_noise_levels(judged, noise_blocks(recording, judged.law, judged.noise.ahead));
    add_class("echoes", judged.classes.echoes,
              pulse_model(instrument, echo_kind(instrument.speckle)), instrument.speckle);
    return judged.figures;
}

}  // namespace sonarsim
