#include "calibrate/judge.h"

#include <algorithm>
#include <cmath>

#include "calibrate/correlations.h"
#include "calibrate/log_statistics.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double db_of_log_power = 4.342944819032518;
constexpr std::size_t least_patches_of_figure = 6;

/// What figures_of() works on.
struct Judged {
    const Recording& recording;
    const InstrumentConfig& instrument;
    LawFit law;      ///< that of the instrument
    NoiseFit noise;  ///< that of the instrument, with the rows of the fit
    PatchClasses classes;
    std::vector<Figure> figures;
};

NoiseFit stated_noise(const InstrumentConfig& instrument, double noise_re_full_scale_db,
                      double absorption_db_per_m, const std::vector<NoiseBlock>& rows) {
    const ReceiverConfig& receiver = instrument.receiver;
    NoiseFit out;
    out.level_db.value = noise_re_full_scale_db;
    out.tvg_log.value = receiver.tvg_log;
    out.tvg_from_m.value = receiver.tvg_from_m;
    out.absorption_db_per_m = receiver.tvg_absorption ? absorption_db_per_m : 0.0;
    out.used = rows;
    return out;
}

void add(Judged& judged, const std::string& name, Tolerance tolerance, double predicted,
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

void add_distribution(Judged& judged, const std::string& where,
                      const std::vector<std::size_t>& chosen) {
    const double full_value = full_value_of(judged.recording);
    const LawFit& law = judged.law;
    const std::vector<PatchMoments> amplitudes =
        patch_moments(judged.recording.pings, full_value, [&](double v, int row) {
            const double range_m = range_of_row(judged.recording, row);
            const double gain = judged.noise.at(range_m) / db_of_log_power;
            return exponential(0.5 * (law.log_power(v, full_value) - gain));
        });
    const std::vector<PatchMoments>& logs = judged.classes.patches;
    add(judged, where + ": variation of the amplitude", Tolerance::tenth,
        amplitude_variation(law.looks), [&](const std::vector<double>& w) {
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
    add(judged, where + ": Weibull shape of the amplitude", Tolerance::tenth,
        to_shape / std::sqrt(log_power_variance(law.looks)), [&](const std::vector<double>& w) {
            return to_shape / std::sqrt(mean_of(logs, chosen, w, &PatchMoments::variance));
        });
}

void add_correlations(Judged& judged, const std::string& where,
                      const std::vector<std::size_t>& chosen, ReceivedKind kind) {
    const PulseConfig& pulse = judged.instrument.pulse;
    const double bins =
        pulse.resolution_m > 0.0 ? pulse.resolution_m / judged.recording.range_step_m : 1.0;
    const auto measured = [&](const std::vector<double>& w) {
        return correlations_of(judged.classes.patches, chosen, w);
    };
    const std::array<double, patch_lags> along_range =
        predicted_range_correlations(bins, pulse.side_lobe_db, kind, judged.law.looks);
    for (const std::size_t lag : {1U, 2U, 4U}) {
        add(judged, where + ": correlation " + std::to_string(lag) + " bins apart",
            Tolerance::correlation, along_range[lag - 1],
            [&](const std::vector<double>& w) { return measured(w).along_range[lag - 1]; });
    }
    const std::vector<double> sines = beam_sines(judged.recording);
    if (sines.size() <= patch_lags) return;
    const BeamConfig& beam = judged.instrument.beam;
    const std::array<double, patch_lags> along_beams = predicted_beam_correlations(
        line_array(radians(beam.width_deg), beam.side_lobe_db), sines, judged.law.looks);
    for (const std::size_t lag : {1U, 2U, 4U}) {
        add(judged, where + ": correlation " + std::to_string(lag) + " beams apart",
            Tolerance::correlation, along_beams[lag - 1],
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
            if (at == measured.end()) continue;
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
             Tolerance::decibel, predicted / count,
             bootstrap(static_cast<int>(levels.size()), mean)});
    }
}

}  // namespace

bool Figure::agrees() const {
    const double off = std::fabs(predicted - measured.value);
    if (tolerance == Tolerance::decibel) return off <= 1.0;
    if (tolerance == Tolerance::correlation) return off <= 0.05;
    const double share = tolerance == Tolerance::tenth ? 0.1 : 0.15;
    return off <= share * std::fabs(measured.value);
}

std::vector<Figure> figures_of(const Recording& recording, const InstrumentConfig& instrument,
                               double noise_re_full_scale_db, double absorption_db_per_m,
                               const std::vector<NoiseBlock>& rows) {
    Judged judged{recording,
                  instrument,
                  stated_law(instrument.receiver),
                  stated_noise(instrument, noise_re_full_scale_db, absorption_db_per_m, rows),
                  {},
                  {}};
    judged.classes = classified(recording, judged.law, judged.noise);
    if (judged.classes.noise.size() >= least_patches_of_figure) {
        add_distribution(judged, "noise", judged.classes.noise);
        add_correlations(judged, "noise", judged.classes.noise, ReceivedKind::noise);
        add_noise_levels(judged, noise_blocks(recording, judged.law));
    }
    if (judged.classes.echoes.size() >= least_patches_of_figure) {
        add_distribution(judged, "echoes", judged.classes.echoes);
        add_correlations(judged, "echoes", judged.classes.echoes, echo_kind(instrument.speckle));
    }
    return judged.figures;
}

}  // namespace sonarsim
