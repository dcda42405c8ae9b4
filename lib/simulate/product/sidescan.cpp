#include "simulate/product/sidescan.h"

#include <limits>

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

double width_of_bin_m(const SonarConfig& config) {
    return (config.range_max_m - config.range_min_m) / config.range_bins;
}

/// False in the columns before the first bin.
bool is_recorded(const Sonar& sonar, const SwathRow& row, double ground_m) {
    const double slant2 = ground_m * ground_m + row.swath.distance_m * row.swath.distance_m;
    return slant2 >= sonar.config.range_min_m * sonar.config.range_min_m;
}

/// The echo at a ground range, 0 beyond the row. `side`: 1 is port, -1 starboard.
double echo_at_ground(const Sonar& sonar, const SwathRow& row, double ground_m, int side) {
    const double distance_m = row.swath.distance_m;
    const double slant_m = std::sqrt(ground_m * ground_m + distance_m * distance_m);
    const auto half = static_cast<std::ptrdiff_t>(row.values.size() / 2);
    const double column_m = slant_m - column_offset_m(sonar.config);
    const auto bin = static_cast<std::ptrdiff_t>(column_m / sonar.settings.view.bin_m());
    if (bin >= half) return 0.0;
    return row.values[static_cast<std::size_t>(side > 0 ? half - 1 - bin : half + bin)];
}

}  // namespace

int blank_columns(const SonarConfig& config) {
    return static_cast<int>(std::lround(config.range_min_m / width_of_bin_m(config)));
}

double column_offset_m(const SonarConfig& config) {
    return config.range_min_m - blank_columns(config) * width_of_bin_m(config);
}

int waterfall_columns(const SonarConfig& config) {
    return 2 * (blank_columns(config) + config.range_bins);
}

std::vector<std::int32_t> waterfall_bins(const SonarConfig& config) {
    const int before = blank_columns(config);
    std::vector<std::int32_t> bins(waterfall_columns(config), -1);
    const int nadir = static_cast<int>(bins.size() / 2);  // the first column to starboard of it
    for (int i = 0; i < config.range_bins; ++i) {
        bins[nadir - 1 - before - i] = 2 * i + Side::port;
        bins[nadir + before + i] = 2 * i + Side::starboard;
    }
    return bins;
}

std::optional<double> first_return_m(const Samples& samples,
                                     std::span<const std::uint8_t> is_bottom, const View& view,
                                     int beam) {
    float nearest_m = std::numeric_limits<float>::infinity();
    for (const Sample& sample : samples.beam(beam)) {
        if (sample.instance >= is_bottom.size() || is_bottom[sample.instance] == 0) continue;
        const auto [range_m, direction] = arrival_of(sample.position);
        const float half_m =
            std::fabs(sample.edge_u.dot(direction)) + std::fabs(sample.edge_v.dot(direction));
        // No point of a plane is nearer than the plane.
        nearest_m = std::min(nearest_m, std::max(range_m - half_m, sample.height_m));
    }
    if (!(nearest_m < view.range_max_m)) return std::nullopt;
    return std::max<double>(nearest_m, view.range_min_m);
}

std::optional<Swath> swath_of(const Sonar& sonar, const Pose& T_world_sensor,
                              std::optional<double> altitude_m) {
    // The sensor looks down along x and has the bow along z.
    const Eigen::Vector3d bow = T_world_sensor.rotation * Eigen::Vector3d::UnitZ();
    const double level = bow.head<2>().norm();
    const double range_max = sonar.config.range_max_m;
    if (!altitude_m || level < 1e-3 || *altitude_m > level * range_max) return std::nullopt;
    const Eigen::Vector2d ahead = bow.head<2>() / level;
    const double distance_m = *altitude_m / level;
    return Swath{
        .nadir_m = T_world_sensor.translation.head<2>() + distance_m * bow.z() * ahead,
        .port = {-ahead.y(), ahead.x()},
        .distance_m = distance_m,
        .altitude_m = *altitude_m,
        .reach_m = std::sqrt(std::max(0.0, range_max * range_max - distance_m * distance_m))};
}

void add_bounds(const Swath& swath, GroundBounds& bounds) {
    for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector2d end = swath.nadir_m + side * swath.reach_m * swath.port;
        bounds.add({end.x(), end.y(), 0.0});
    }
}

void add_between(const Sonar& sonar, const SwathRow& before, const SwathRow& row,
                 GroundGrid& mosaic) {
    const double cell_m = mosaic.cell_m;
    const bool is_near =
        before.swath.port.dot(row.swath.port) > 0.98480775301220806 &&  // cos(10 degrees)
        (row.swath.nadir_m - before.swath.nadir_m).norm() < 10.0 * cell_m;
    const SwathRow& first = is_near ? before : row;
    const double reach = std::min(first.swath.reach_m, row.swath.reach_m);
    const double step = 0.5 * std::min(cell_m, sonar.settings.view.bin_m());
    for (const int side : {1, -1}) {
        for (int n = 0; (n + 0.5) * step < reach; ++n) {
            const double ground = (n + 0.5) * step;
            if (!is_recorded(sonar, row, ground) || !is_recorded(sonar, first, ground)) continue;
            const Eigen::Vector2d from = first.swath.nadir_m + side * ground * first.swath.port;
            const Eigen::Vector2d way = row.swath.nadir_m + side * ground * row.swath.port - from;
            const double echo = echo_at_ground(sonar, row, ground, side);
            const double change = echo_at_ground(sonar, first, ground, side) - echo;
            const int points = std::max(1, static_cast<int>(std::ceil(way.norm() / cell_m * 4.0)));
            const double share = ground / reach;
            // A vehicle that stands still covers ground, too.
            const double width = std::max(way.norm(), 0.05 * cell_m) / points;
            for (int k = 0; k < points; ++k) {
                const double part = (k + 0.5) / points;
                const Eigen::Vector2d at = from + part * way;
                mosaic.add({at.x(), at.y(), echo + (1.0 - part) * change},
                           4.0 * share * (1.0 - share) * width);
            }
        }
    }
}

}  // namespace sonarsim
