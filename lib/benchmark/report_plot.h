#pragma once

#include <string>

#include "benchmark/drawing.h"
#include "benchmark/report.h"

namespace sonarsim {

/// A point of a plot.
struct PlotPoint {
    double x;
    double y;
    std::string label;
    bool ringed = false;  ///< by a circle: "what you have now"
};

struct PlotSeries {
    std::string name;
    Colour colour;
    std::vector<PlotPoint> points;
    bool joined = false;  ///< by a line, in the order given
    bool dots = true;
};

struct Plot {
    std::string title, x_title, y_title;
    std::vector<PlotSeries> series;
};

/// A plot with two logarithmic axes. Points that are not positive have no place on them and are
/// left out.
Drawing draw_log_log(const Plot& plot);

/// Relative L1 against ms per ping, for one sonar.
Plot error_plot(const Report& report, const std::string& sensor);

/// ms per ping against the size of the scene, for one sonar.
Plot growth_plot(const Report& report, const std::string& sensor);

}  // namespace sonarsim
