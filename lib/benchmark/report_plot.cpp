#include "benchmark/report_plot.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr int width = 720;
constexpr int height = 480;
constexpr double left = 70.0;
constexpr double right = 20.0;
constexpr double top = 40.0;
constexpr double bottom = 55.0;

constexpr Colour black{30, 30, 30};
constexpr Colour grey{225, 225, 225};
constexpr Colour blue{31, 119, 180};
constexpr Colour orange{230, 120, 20};
constexpr Colour green{60, 150, 60};

/// One logarithmic axis, from `low` to `high` in decades.
struct Axis {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double from = 0.0;  ///< pixels
    double to = 0.0;

    void include(double value) {
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    /// A little room at both ends.
    void round() {
        if (!(low <= high)) low = high = 0.0;
        const double room = 0.06 * std::max(high - low, 0.5);
        low -= room;
        high += room;
    }
    double pixel(double value) const {
        return from + (std::log10(value) - low) / (high - low) * (to - from);
    }
    /// Where the marks are: 1, 2 and 5 in every decade, or 1 alone where there are many decades.
    std::vector<double> marks() const {
        std::vector<double> out;
        for (int decade = static_cast<int>(std::floor(low)); decade <= std::ceil(high); ++decade) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double value = digit * std::pow(10.0, decade);
                const bool many = high - low > 4.0;
                if (many && digit != 1.0) continue;
                if (std::log10(value) >= low && std::log10(value) <= high) out.push_back(value);
            }
        }
        return out;
    }
};

bool has_place(const PlotPoint& point) {
    return point.x > 0.0 && point.y > 0.0 && std::isfinite(point.x) && std::isfinite(point.y);
}

void draw_grid(const Plot& plot, const Axis& x, const Axis& y, Drawing& out) {
    const auto text = [](double value) { return fmt::format("{:g}", value); };
    for (const double mark : x.marks()) {
        const double at = x.pixel(mark);
        out.shapes.push_back(Line{at, y.from, at, y.to, 1.0, grey});
        out.shapes.push_back(Label{at, y.from + 18.0, text(mark), Anchor::middle, black});
    }
    for (const double mark : y.marks()) {
        const double at = y.pixel(mark);
        out.shapes.push_back(Line{x.from, at, x.to, at, 1.0, grey});
        out.shapes.push_back(Label{x.from - 6.0, at + 4.0, text(mark), Anchor::end, black});
    }
    out.shapes.push_back(Line{x.from, y.from, x.to, y.from, 1.0, black});
    out.shapes.push_back(Line{x.from, y.from, x.from, y.to, 1.0, black});
    out.shapes.push_back(
        Label{0.5 * (x.from + x.to), height - 12.0, plot.x_title, Anchor::middle, black});
    out.shapes.push_back(Label{12.0, top - 12.0, plot.y_title, Anchor::start, black});
    out.shapes.push_back(Label{0.5 * (x.from + x.to), 18.0, plot.title, Anchor::middle, black});
}

void draw_series(const PlotSeries& series, const Axis& x, const Axis& y, Drawing& out) {
    const PlotPoint* last = nullptr;
    for (const PlotPoint& point : series.points) {
        if (!has_place(point)) continue;
        const double px = x.pixel(point.x);
        const double py = y.pixel(point.y);
        if (series.joined && last != nullptr) {
            out.shapes.push_back(
                Line{x.pixel(last->x), y.pixel(last->y), px, py, 1.5, series.colour});
        }
        last = &point;
        if (series.dots) out.shapes.push_back(Disc{px, py, 4.0, 0.0, series.colour});
        if (point.ringed) out.shapes.push_back(Disc{px, py, 8.0, 2.0, black});
        if (!point.label.empty()) {
            // A label that would leave the plot stands on the other side of its point.
            const bool flip = px > x.to - 90.0;
            out.shapes.push_back(Label{px + (flip ? -9.0 : 9.0), py - 5.0, point.label,
                                       flip ? Anchor::end : Anchor::start, series.colour});
        }
    }
}

Colour colour_of(const std::string& engine) {
    return engine == "rays" ? blue : engine == "octree" ? orange : green;
}

/// "leaf_m=0.02" is "0.02" where the series says the rest.
std::string short_label(const std::string& setting) {
    return setting.substr(setting.find('=') + 1);
}

}  // namespace

Drawing draw_log_log(const Plot& plot) {
    Drawing out{width, height, {}};
    Axis x{.from = left, .to = width - right};
    Axis y{.from = height - bottom, .to = top};
    for (const PlotSeries& series : plot.series) {
        for (const PlotPoint& point : series.points) {
            if (!has_place(point)) continue;
            x.include(point.x);
            y.include(point.y);
        }
    }
    x.round();
    y.round();
    draw_grid(plot, x, y, out);
    double row = top + 16.0;
    for (const PlotSeries& series : plot.series) {
        draw_series(series, x, y, out);
        out.shapes.push_back(Line{x.to - 190.0, row - 4.0, x.to - 170.0, row - 4.0,
                                  series.dots ? 6.0 : 1.5, series.colour});
        out.shapes.push_back(Label{x.to - 162.0, row, series.name, Anchor::start, black});
        row += 17.0;
    }
    return out;
}

Plot error_plot(const Report& report, const std::string& sensor) {
    Plot plot{
        report.mission + ", " + sensor, "ms per ping, one thread, noise on", "relative L1", {}};
    PlotSeries front{"nothing faster and better", {150, 150, 150}, {}, true, false};
    for (const char* const engine : {"rays", "octree", "literal"}) {
        PlotSeries series{engine == std::string("rays")     ? "rays by relative_l1"
                          : engine == std::string("octree") ? "octree by leaf_m"
                                                            : "octree literal by leaf_m",
                          colour_of(engine),
                          {}};
        for (const ReportRow& row : report.rows) {
            if (row.sensor != sensor || row.setting.engine != engine) continue;
            const PlotPoint point{row.ms_per_ping.centre, row.relative_l1.centre,
                                  short_label(row.setting.name), row.setting.current};
            series.points.push_back(point);
            if (row.on_front) front.points.push_back({point.x, point.y, "", false});
        }
        if (!series.points.empty()) plot.series.push_back(series);
    }
    std::ranges::sort(front.points, {}, &PlotPoint::x);
    plot.series.insert(plot.series.begin(), front);
    return plot;
}

Plot growth_plot(const Report& report, const std::string& sensor) {
    Plot plot{report.mission + ", " + sensor, "triangles", "ms per ping", {}};
    for (const Growth& growth : report.growth) {
        if (growth.sensor != sensor) continue;
        Colour colour = colour_of(growth.engine);
        if (growth.along == "area") {
            for (std::uint8_t& c : colour)
                c = static_cast<std::uint8_t>(c / 2);
        }
        PlotSeries series{
            fmt::format("{}, {}: ^{:.2f}", growth.engine, growth.along, growth.exponent),
            colour,
            {},
            true};
        for (std::size_t i = 0; i < growth.triangles.size(); ++i)
            series.points.push_back({growth.triangles[i], growth.ms_per_ping[i], "", false});
        plot.series.push_back(series);
    }
    return plot;
}

}  // namespace sonarsim
