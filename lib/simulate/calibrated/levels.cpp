#include "simulate/calibrated/levels.h"

#include "simulate/calibrated/decibel.h"

namespace sonarsim {

namespace {

constexpr double min_noise_db = -300.0;
constexpr double max_noise_db = 200.0;
constexpr double max_gain_db = 370.0;

}  // namespace

double float_headroom_db(double noise_db) {
    const double at_least = std::max(0.0, min_noise_db - noise_db);
    return std::min(at_least, max_noise_db - noise_db);
}

std::vector<float> row_gains(const ReceiverConfig& receiver, const InstrumentLevels& levels,
                             const View& view, double absorption_db_per_m, double raised_db) {
    std::vector<float> out;
    for (int i = 0; i < view.range_bins; ++i) {
        const double range = view.range_min_m + (i + 0.5) * view.bin_m();
        const double gain_db = levels.source_level_db +
                               tvg_db(receiver, absorption_db_per_m, range) - levels.full_scale_db -
                               raised_db;
        out.push_back(static_cast<float>(power_of_db(std::min(gain_db, max_gain_db))));
    }
    return out;
}

}  // namespace sonarsim
