#include "calibrate/calibrate.h"

#include <algorithm>
#include <cmath>

#include "calibrate/usable.h"
#include "calibrated/model.h"
#include "calibrated/pulse_band.h"
#include "core/elementary.h"
#include "core/text.h"
#include "core/units.h"
#include "sonar/sonar.h"

namespace sonarsim {

namespace {

/// The extent of a row of evenly spaced numbers, half a step beyond the outer two.
double full_extent(const std::vector<double>& row) {
    const auto [least, most] = std::minmax_element(row.begin(), row.end());
    const auto count = static_cast<double>(row.size());
    return (*most - *least) * count / std::max(count - 1.0, 1.0);
}

/// Unevenness of the steps of a row of numbers: their variance over their squared mean.
double unevenness(const std::vector<double>& row) {
    double sum = 0.0, square = 0.0;
    for (std::size_t k = 1; k < row.size(); ++k) {
        const double step = row[k] - row[k - 1];
        sum += step;
        square += step * step;
    }
    const double mean = sum / static_cast<double>(row.size() - 1);
    return square / static_cast<double>(row.size() - 1) / (mean * mean) - 1.0;
}

/// The sonar of the start with the shape of the pings.
SonarConfig of_shape(SonarConfig config, const Recording& recording) {
    const double step_m = recording.range_step_m;
    config.range_bins = recording.pings.front().ranges;
    config.range_min_m = std::max(recording.first_range_m - 0.5 * step_m, 0.0);
    config.range_max_m = recording.first_range_m + (config.range_bins - 0.5) * step_m;
    if (config.kind != SonarKind::imaging || recording.bearing_rad.size() < 2) return config;
    config.azimuth_bins = recording.pings.front().beams;
    const std::vector<double> sines = beam_sines(recording);
    const bool sine = unevenness(sines) < unevenness(recording.bearing_rad);
    config.azimuth_deg = degrees(sine ? 2.0 * arcsin(std::min(0.5 * full_extent(sines), 1.0))
                                      : full_extent(recording.bearing_rad));
    config.instrument.beam.spread = sine ? BeamSpacing::equal_sine : BeamSpacing::equal_angle;
    return config;
}

StartInstrument start_instrument(const SonarConfig& config, const WaterConfig& water) {
    const Sonar sonar = make_sonar(config, {}, water);
    const auto& model = dynamic_cast<const CalibratedModel&>(*sonar.settings.model);
    return {config.instrument, model.levels, model.absorption_db_per_m};
}

void add_shape(const SonarConfig& config, std::vector<PresetValue>& out) {
    const char* const file = "file: of the pings";
    if (config.kind == SonarKind::imaging) {
        out.push_back({"azimuth_deg", number_text(config.azimuth_deg), file});
        out.push_back({"azimuth_bins", std::to_string(config.azimuth_bins), file});
        const bool sine = config.instrument.beam.spread == BeamSpacing::equal_sine;
        out.push_back({"instrument.beam.spread", sine ? "sine" : "angle", file});
    }
    out.push_back({"range_min_m", number_text(config.range_min_m), file});
    out.push_back({"range_max_m", number_text(config.range_max_m), file});
    out.push_back({"range_bins", std::to_string(config.range_bins), file});
}

void add_estimates(const ImageFit& fit, const StartInstrument& start,
                   std::vector<PresetValue>& out) {
    for (const KeyEstimate& e : fit.estimates) {
        const std::string key = "instrument." + e.key;
        if (!e.word.empty()) {
            out.push_back({key, e.word, "fit"});
            continue;
        }
        out.push_back({key, four_digits(e.number.value),
                       "fit: " + four_digits(e.number.low) + " to " + four_digits(e.number.high)});
    }
    if (fit.noise && !start.config.receiver.tvg_absorption) {
        out.push_back({"instrument.receiver.tvg_absorption", "true",
                       "rule: tvg_log is fitted beside the absorption of the water"});
    }
    if (fit.noise && fit.noise->tvg_from_m.value == 0.0 && start.config.receiver.tvg_from_m > 0.0) {
        out.push_back(
            {"instrument.receiver.tvg_from_m", "0", "rule: the pings show no start of the gain"});
    }
    if (fit.noise && !start.config.receiver.noise_db) {
        out.push_back({"instrument.receiver.noise_db", four_digits(start.levels.noise_db),
                       "rule: that of the start; full_scale_db is fitted to it"});
    }
}

void judge_images(const SplitRecording& parts, const StartInstrument& start, const ImageFit& fit,
                  Calibration& out) {
    const double absorption = start.absorption_db_per_m;
    const double start_level = start.levels.noise_db - start.levels.full_scale_db;
    const auto of_fit = [&](const Recording& part) {
        return figures_of(part, fit.config, fit.noise_re_full_scale_db, absorption, fit.noise);
    };
    const std::vector<Figure> before =
        figures_of(parts.judged, start.config, start_level, absorption, fit.noise);
    const std::vector<Figure> in_sample = of_fit(parts.fitted);
    const std::vector<Figure> held_out = of_fit(parts.judged);
    const auto named = [](const std::vector<Figure>& figures, const std::string& name) {
        return std::find_if(figures.begin(), figures.end(),
                            [&](const Figure& figure) { return figure.name == name; });
    };
    for (const Figure& figure : held_out) {
        const auto a = named(before, figure.name);
        const auto b = named(in_sample, figure.name);
        if (a != before.end() && b != in_sample.end()) out.figures.push_back({*a, *b, figure});
    }
}

void calibrate_images(const SplitRecording& parts, const SonarConfig& start,
                      const WaterConfig& water, Calibration& out) {
    const SonarConfig shaped = of_shape(start, parts.fitted);
    const StartInstrument instrument = start_instrument(shaped, water);
    const ImageFit fit = fit_image(parts.fitted, instrument);
    out.estimates = fit.estimates;
    out.notes = fit.notes;
    add_shape(shaped, out.preset);
    add_estimates(fit, instrument, out.preset);
    judge_images(parts, instrument, fit, out);
}

/// A figure of soundings at one angle. The start predicts neither the bottom nor its spread, so its
/// column repeats what was measured, without a prediction.
JudgedFigure of_angle(const std::string& name, FitTolerance tolerance, const Bounded& fitted,
                      double predicted, const Bounded& held_out) {
    return {{name, tolerance, std::nan(""), held_out},
            {name, tolerance, fitted.value, fitted},
            {name, tolerance, predicted, held_out}};
}

void calibrate_soundings(const SplitRecording& parts, const SonarConfig& start,
                         const WaterConfig& water, const CalibrationOptions& options,
                         Calibration& out) {
    const InstrumentConfig& instrument = start.instrument;
    const double samples = 1.0 * start.range_bins * instrument.receiver.samples;
    const double sample_m = (start.range_max_m - start.range_min_m) / samples;
    const PulseBand band = pulse_band(instrument.pulse, sample_m, water.sound_speed_m_s);
    const SoundingsGeometry geometry{band.length_m, radians(instrument.beam.width_deg),
                                     instrument.receiver.tvg_log};
    out.soundings =
        fit_soundings(parts.fitted.soundings, parts.fitted.law, options.slope_rad, geometry);
    const SoundingsFit& fit = *out.soundings;
    const SoundingsFit judged =
        fit_soundings(parts.judged.soundings, parts.judged.law, options.slope_rad, geometry);
    for (std::size_t j = 0; j < judged.angles_rad.size(); ++j) {
        const double angle = judged.angles_rad[j];
        const auto nearest = std::min_element(
            fit.angles_rad.begin(), fit.angles_rad.end(),
            [&](double x, double y) { return std::fabs(x - angle) < std::fabs(y - angle); });
        const auto k = static_cast<std::size_t>(nearest - fit.angles_rad.begin());
        const std::string at = ", " + four_digits(std::round(degrees(angle))) + " degrees";
        out.figures.push_back(of_angle("strength with the level of the sonar" + at + ", dB",
                                       FitTolerance::decibel, fit.strength_db[k],
                                       fit.strength_db_at(angle), judged.strength_db[j]));
        out.figures.push_back(of_angle("spread of ranges" + at + ", m",
                                       FitTolerance::three_twentieths, fit.spread_m[k],
                                       fit.spread_m_at(angle), judged.spread_m[j]));
    }
    out.notes = {
        "transmit level, gain and strength of the bottom cannot be separated here: the levels have "
        "their sum",
        "on a flat bottom range and angle go together: the gain by range and the strength by angle "
        "cannot be separated, so tvg_log is that of the start",
        "the spread of the ranges is a table by angle: it depends on how the sonar detects the "
        "bottom, "
        "which has no key. No key of the preset changes",
    };
}

/// Adds a note if the judged pings have other figures than the fitted ones: no instrument with
/// constant settings fits both.
void note_change(Calibration& out) {
    const auto changed =
        std::count_if(out.figures.begin(), out.figures.end(), [](const JudgedFigure& figure) {
            const Bounded& one = figure.in_sample.measured;
            const Bounded& other = figure.held_out.measured;
            return one.low > other.high || one.high < other.low;
        });
    if (5 * changed <= std::ssize(out.figures)) return;
    out.notes.push_back(std::to_string(changed) + " of " + std::to_string(out.figures.size()) +
                        " figures of the judged pings lie outside the intervals of the fitted "
                        "ones: the scene or the sonar changed between them");
}

}  // namespace

Calibration calibrate(const Recording& recording, const SonarConfig& start,
                      const WaterConfig& water, const CalibrationOptions& options) {
    check_usable(recording, start.kind);
    const SplitRecording parts = split(recording, options.judged_share, options.reversed);
    WaterConfig with_speed = water;
    with_speed.sound_speed_m_s = recording.sound_speed_m_s;
    Calibration out;
    out.name = recording.name;
    out.pings_fitted = std::max(parts.fitted.pings.size(), parts.fitted.soundings.size());
    out.pings_judged = std::max(parts.judged.pings.size(), parts.judged.soundings.size());
    if (recording.kind == RecordedKind::soundings) {
        calibrate_soundings(parts, start, with_speed, options, out);
    } else {
        calibrate_images(parts, start, with_speed, out);
    }
    note_change(out);
    return out;
}

}  // namespace sonarsim
