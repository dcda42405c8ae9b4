#include "simulate/visibility/angles.h"

namespace sonarsim {

namespace {

/// Adds `count` columns of equal width that together cover [low, high] across.
void add_columns(int beam, double low, double high, int count, double along_min, double along_max,
                 std::vector<ViewColumn>& out) {
    const double width = (high - low) / count;
    for (int c = 0; c < count; ++c) {
        out.push_back({beam, low + (c + 0.5) * width, width, along_min, along_max});
    }
}

}  // namespace

std::vector<ViewColumn> view_columns(const View& view, int per_beam) {
    const double half_azimuth = 0.5 * view.azimuth_rad;
    const double half_elevation = 0.5 * view.elevation_rad;
    std::vector<ViewColumn> out;
    switch (view.shape) {
        case ViewShape::fan:
            for (int j = 0; j < view.beams; ++j) {
                const double width = view.azimuth_rad / view.beams;
                add_columns(j, -half_azimuth + j * width, -half_azimuth + (j + 1) * width, per_beam,
                            -half_elevation, half_elevation, out);
            }
            break;
        case ViewShape::port_starboard:
            add_columns(0, -half_elevation, half_elevation, per_beam, -half_azimuth, 0.0, out);
            add_columns(1, -half_elevation, half_elevation, per_beam, 0.0, half_azimuth, out);
            break;
        case ViewShape::cone:
            add_columns(0, -pi, pi, per_beam, 0.0, half_azimuth, out);
            break;
    }
    return out;
}

}  // namespace sonarsim
