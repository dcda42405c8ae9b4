#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/calibrate.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

std::string of_interval(const Bounded& m) {
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", m.value, m.low, m.high);
}

std::string verdict(const Figure& figure) {
    if (!std::isfinite(figure.predicted)) return "-";
    return figure.agrees() ? "yes" : "NO";
}

std::string prediction(const Figure& figure) {
    return std::isfinite(figure.predicted) ? fmt::format("{:.4g}", figure.predicted) : "-";
}

Json interval_json(const Bounded& m) {
    return {{"value", m.value}, {"low", m.low}, {"high", m.high}};
}

Json column_json(const Figure& figure) {
    if (!std::isfinite(figure.predicted)) return nullptr;
    return {{"predicted", figure.predicted},
            {"measured", interval_json(figure.measured)},
            {"agrees", figure.agrees()}};
}

struct Agreements {
    int start = 0, in_sample = 0, held_out = 0;
};

Agreements agreements(const Calibration& calibration) {
    Agreements out;
    for (const JudgedFigure& figure : calibration.figures) {
        out.start += std::isfinite(figure.start.predicted) && figure.start.agrees() ? 1 : 0;
        out.in_sample += figure.in_sample.agrees() ? 1 : 0;
        out.held_out += figure.held_out.agrees() ? 1 : 0;
    }
    return out;
}

}  // namespace

std::string four_digits(double value) {
    return fmt::format("{:.4g}", value);
}

std::string calibration_text(const Calibration& calibration) {
    std::string out = fmt::format("{}: {} pings fitted, {} judged\n\n", calibration.name,
                                  calibration.pings_fitted, calibration.pings_judged);
    for (const KeyEstimate& e : calibration.estimates) {
        out += fmt::format("  {:28} {}\n", e.key, e.word.empty() ? of_interval(e.number) : e.word);
    }
    if (calibration.soundings) {
        const SoundingsFit& fit = *calibration.soundings;
        out += fmt::format("  {:28} {}\n", "Lambert's level, dB", of_interval(fit.lambert_db));
        out += fmt::format("  {:28} {}\n", "facets over it, dB", of_interval(fit.facets_db));
        out += fmt::format("  {:28} {}\n", "their slope, degrees", of_interval(fit.slope_rms_deg));
    }
    out += fmt::format("\n{:46} {:>9} {:>5} {:>9} {:>28} {:>5} {:>28} {:>5}\n", "figure", "start",
                       "", "fit", "fitted pings", "", "judged pings", "");
    for (const JudgedFigure& f : calibration.figures) {
        out += fmt::format("{:46} {:>9} {:>5} {:>9} {:>28} {:>5} {:>28} {:>5}\n", f.held_out.name,
                           prediction(f.start), verdict(f.start), prediction(f.held_out),
                           of_interval(f.in_sample.measured), verdict(f.in_sample),
                           of_interval(f.held_out.measured), verdict(f.held_out));
    }
    const Agreements n = agreements(calibration);
    out += fmt::format(
        "{} figures agree: {} of the start, {} of the fit with the fitted pings, {} with "
        "the judged ones\n",
        calibration.figures.size(), n.start, n.in_sample, n.held_out);
    for (const std::string& note : calibration.notes)
        out += "- " + note + "\n";
    return out;
}

Json calibration_json(const Calibration& calibration) {
    Json estimates = Json::object();
    for (const KeyEstimate& e : calibration.estimates)
        estimates[e.key] = e.word.empty() ? interval_json(e.number) : Json(e.word);
    Json figures = Json::array();
    for (const JudgedFigure& f : calibration.figures) {
        figures.push_back({{"figure", f.held_out.name},
                           {"start", column_json(f.start)},
                           {"in_sample", column_json(f.in_sample)},
                           {"held_out", column_json(f.held_out)}});
    }
    const Agreements n = agreements(calibration);
    Json out = {
        {"recording", calibration.name},
        {"pings_fitted", calibration.pings_fitted},
        {"pings_judged", calibration.pings_judged},
        {"estimates", std::move(estimates)},
        {"figures", std::move(figures)},
        {"agree", {{"start", n.start}, {"in_sample", n.in_sample}, {"held_out", n.held_out}}},
        {"notes", calibration.notes}};
    if (!calibration.soundings) return out;
    const SoundingsFit& fit = *calibration.soundings;
    out["bottom"] = {{"lambert_db", interval_json(fit.lambert_db)},
                     {"facets_db", interval_json(fit.facets_db)},
                     {"slope_rms_deg", interval_json(fit.slope_rms_deg)}};
    return out;
}

}  // namespace sonarsim
