#pragma once

#include <string>
#include <vector>

namespace sonarsim {

/// The rule that makes a figure of its cells.
enum class Reduce {
    mean,     ///< weighted mean of the values
    level,    ///< 10 log10 of the weighted mean
    quantile  ///< value below which a share of the weight lies
};

/// The distance within which two values of a figure agree.
enum class Tolerance {
    tenth,        ///< 10 % of the real value
    decibel,      ///< 1 dB
    correlation,  ///< 0.05
    share,        ///< 10 % of the real value or 0.001
};

/// A value of a figure at one place of the image in one ping.
struct Cell {
    int location = 0;  ///< cells of one place share it, in all pings
    int ping = 0;
    float value = 0.0F;
    float weight = 1.0F;
};

/// A figure before its cells are joined.
struct Measured {
    std::string name;  ///< "bottom: Weibull shape"
    Reduce reduce = Reduce::mean;
    Tolerance tolerance = Tolerance::tenth;
    double share = 0.5;  ///< for `quantile`
    std::vector<Cell> cells;
};

/// The counts of the bins at each place, all pings together.
struct MeasuredHistogram {
    std::string name;
    double bin_width = 1.0;  ///< in the unit of the earth mover's distance
    std::string unit;
    std::vector<std::vector<double>> counts;  ///< one list for each location
};

/// All figures of a recording.
struct Measurement {
    std::vector<Measured> figures;
    std::vector<MeasuredHistogram> histograms;
    std::vector<double> level_by_range_db;  ///< for the plot
    double first_range_m = 0.0;
    double range_step_m = 0.0;
};

}  // namespace sonarsim
