#include "compare/report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "compare/advice.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// Four digits.
std::string digits(double value) {
    if (!std::isfinite(value)) return "-";
    return fmt::format("{:.4g}", value);
}

std::string interval(double value, double half) {
    return half > 0.0 ? fmt::format("{} +- {:.2g}", digits(value), half) : digits(value);
}

std::string word_of(const ComparedFigure& figure) {
    if (figure.differs) return figure.agrees ? "agrees, measurably different" : "DIFFERS";
    return figure.agrees ? "agrees" : "off, perhaps by chance";
}

Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace

std::string verdict_text(const Comparison& c) {
    std::string text = fmt::format(
        "{} of {} figures agree ({:.0f} %): their difference is within the tolerance or within its "
        "95 % interval.\n",
        c.agreeing, c.figures.size(), 100.0 * c.agreement());
    if (c.is_same()) {
        return text + "Same: no figure differs significantly (5 % for all figures together).\n";
    }
    return text + fmt::format(
                      "Not the same: {} figures differ significantly (5 % for all figures "
                      "together).\n",
                      c.differing);
}

std::string comparison_text(const Comparison& c) {
    std::size_t width = 6;
    for (const ComparedFigure& figure : c.figures)
        width = std::max(width, figure.name.size());
    std::string text = fmt::format("{:{}}  {:>19}  {:>19}  {:>19}  {}\n", "figure", width, "real",
                                   "simulated", "difference", "");
    for (const ComparedFigure& f : c.figures) {
        const Estimate& e = f.estimate;
        text += fmt::format("{:{}}  {:>19}  {:>19}  {:>19}  {}\n", f.name, width,
                            interval(e.real, f.real_half), interval(e.simulated, f.simulated_half),
                            interval(e.simulated - e.real, f.difference_half), word_of(f));
    }
    for (const ComparedHistogram& h : c.histograms) {
        text += fmt::format(
            "{}: Jensen-Shannon {} bits (by chance up to {}), Kullback-Leibler {} nats, earth "
            "mover's {} {}\n",
            h.name, digits(h.jensen_shannon), digits(h.chance_jensen_shannon),
            digits(h.kullback_leibler), digits(h.earth_movers), h.unit);
    }
    if (c.has_relative_levels)
        text += "Levels are relative to the mean of each recording: one has no full_value.\n";
    text += verdict_text(c);
    if (c.first_change >= 0) {
        const ComparedFigure& first = c.figures[static_cast<std::size_t>(c.first_change)];
        text += fmt::format("Change first: {} ({} standard errors off). It follows {}.\n",
                            first.name, digits(first.standardised), keys_behind(first.name));
    }
    return text;
}

Json comparison_json(const Comparison& c) {
    Json json = {{"format", "sonarsim comparison"},
                 {"format_version", 1},
                 {"real", {{"name", c.real}, {"pings", c.real_pings}}},
                 {"simulated", {{"name", c.simulated}, {"pings", c.simulated_pings}}},
                 {"one_grid", c.has_one_grid},
                 {"relative_levels", c.has_relative_levels},
                 {"figures_agreeing", c.agreeing},
                 {"figures_differing", c.differing},
                 {"agreement", c.agreement()},
                 {"same", c.is_same()},
                 {"change_first", nullptr},
                 {"figures", Json::array()},
                 {"histograms", Json::array()}};
    for (const ComparedFigure& f : c.figures) {
        const Estimate& e = f.estimate;
        json["figures"].push_back({{"name", f.name},
                                   {"real", finite(e.real)},
                                   {"real_half_interval", f.real_half},
                                   {"simulated", finite(e.simulated)},
                                   {"simulated_half_interval", f.simulated_half},
                                   {"difference", finite(e.simulated - e.real)},
                                   {"difference_half_interval", f.difference_half},
                                   {"tolerance", f.tolerance},
                                   {"standardised", f.standardised},
                                   {"p", e.p},
                                   {"adjusted_p", f.adjusted_p},
                                   {"agrees", f.agrees},
                                   {"differs", f.differs}});
    }
    for (const ComparedHistogram& h : c.histograms) {
        json["histograms"].push_back({{"name", h.name},
                                      {"jensen_shannon_bits", h.jensen_shannon},
                                      {"usual_jensen_shannon_bits", h.chance_jensen_shannon},
                                      {"kullback_leibler_nats", h.kullback_leibler},
                                      {"earth_movers", h.earth_movers},
                                      {"earth_movers_unit", h.unit}});
    }
    if (c.first_change >= 0) {
        const ComparedFigure& first = c.figures[static_cast<std::size_t>(c.first_change)];
        json["change_first"] = {{"figure", first.name},
                                {"standardised", first.standardised},
                                {"keys", keys_behind(first.name)}};
    }
    return json;
}

}  // namespace sonarsim
