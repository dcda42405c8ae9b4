#include "compare/plot.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace sonarsim {

namespace {

constexpr int width_px = 900;
constexpr int levels_px = 300;
constexpr int row_px = 16;
constexpr int left_px = 330;
constexpr double most_standardised = 10.0;
constexpr const char* real_colour = "#1b6ca8";
constexpr const char* simulated_colour = "#c8553d";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else
            out += c;
    }
    return out;
}

struct Axes {
    double x0 = 0.0, x1 = 1.0, y0 = 0.0, y1 = 1.0;

    double x(double value) const { return 60.0 + (width_px - 80.0) * (value - x0) / (x1 - x0); }
    double y(double value) const {
        return 20.0 + (levels_px - 60.0) * (1.0 - (value - y0) / (y1 - y0));
    }
};

void widen(const Measurement& m, Axes& axes, bool is_first) {
    for (std::size_t i = 0; i < m.level_by_range_db.size(); ++i) {
        const double range = m.first_range_m + static_cast<double>(i) * m.range_step_m;
        const double level = m.level_by_range_db[i];
        if (is_first && i == 0) axes = {range, range, level, level};
        axes = {std::min(axes.x0, range), std::max(axes.x1, range), std::min(axes.y0, level),
                std::max(axes.y1, level)};
    }
}

std::string curve(const Measurement& m, const Axes& axes, const char* colour) {
    std::string points;
    for (std::size_t i = 0; i < m.level_by_range_db.size(); ++i) {
        const double range = m.first_range_m + static_cast<double>(i) * m.range_step_m;
        points += fmt::format("{:.1f},{:.1f} ", axes.x(range), axes.y(m.level_by_range_db[i]));
    }
    return fmt::format("<polyline fill='none' stroke='{}' points='{}'/>\n", colour, points);
}

std::string levels_svg(const Comparison& c) {
    if (c.real_levels.level_by_range_db.empty()) return "";
    Axes axes;
    widen(c.real_levels, axes, true);
    widen(c.simulated_levels, axes, false);
    if (!(axes.x1 > axes.x0) || !(axes.y1 > axes.y0)) return "";
    std::string out = fmt::format(
        "<text x='60' y='14'>level by range, dB; <tspan fill='{}'>real"
        "</tspan>, <tspan fill='{}'>simulated</tspan></text>\n",
        real_colour, simulated_colour);
    for (int k = 0; k <= 4; ++k) {
        const double level = axes.y0 + (axes.y1 - axes.y0) * k / 4.0;
        const double range = axes.x0 + (axes.x1 - axes.x0) * k / 4.0;
        out += fmt::format(
            "<text x='5' y='{:.1f}'>{:.1f}</text><line x1='60' x2='{}' y1='{:.1f}' "
            "y2='{:.1f}' stroke='#ddd'/>\n",
            axes.y(level) + 4.0, level, width_px - 20, axes.y(level), axes.y(level));
        out += fmt::format("<text x='{:.1f}' y='{}'>{:.2f} m</text>\n", axes.x(range) - 20.0,
                           levels_px - 22, range);
    }
    return out + curve(c.real_levels, axes, real_colour) +
           curve(c.simulated_levels, axes, simulated_colour);
}

}  // namespace

std::string comparison_svg(const Comparison& c) {
    const std::string levels = levels_svg(c);
    const int top = levels.empty() ? 40 : levels_px + 30;
    const int height = top + row_px * static_cast<int>(c.figures.size()) + 20;
    std::string out =
        fmt::format(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}' "
            "font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' "
            "fill='white'/>\n",
            width_px, height) +
        levels;
    const double middle = 0.5 * (left_px + width_px);
    const double scale = (0.5 * (width_px - left_px) - 20.0) / most_standardised;
    out += fmt::format(
        "<text x='{}' y='{}'>difference in standard errors, cut at {}; grey: 1.96 of them; "
        "blue: agrees"
        "</text>\n<rect x='{:.1f}' y='{}' width='{:.1f}' height='{}' fill='#eee'/>\n",
        left_px, top - 12, most_standardised, middle - 1.96 * scale, top - 6, 2.0 * 1.96 * scale,
        row_px * static_cast<int>(c.figures.size()) + 8);
    for (std::size_t i = 0; i < c.figures.size(); ++i) {
        const ComparedFigure& figure = c.figures[i];
        const double y = top + row_px * static_cast<double>(i) + 6.0;
        const double off = std::clamp(figure.standardised, -most_standardised, most_standardised);
        out += fmt::format(
            "<text x='5' y='{:.1f}'>{}</text><circle cx='{:.1f}' cy='{:.1f}' r='4' "
            "fill='{}'/>\n",
            y + 4.0, escaped(figure.name), middle + off * scale, y,
            figure.agrees ? real_colour : simulated_colour);
    }
    return out + "</svg>\n";
}

}  // namespace sonarsim
