#include <cmath>

#include "core/units.h"
#include "run/checks/survey.h"

namespace sonarsim {

namespace {

constexpr int all_around = 1000;
// Within the field of view.
constexpr int across = 17;
constexpr int up_and_down = 5;

/// The middle of the i-th of n equal parts of an angle that is centred on 0.
double part_centre(double whole, int i, int n) {
    return whole * ((i + 0.5) / n - 0.5);
}

}  // namespace

std::vector<Eigen::Vector3f> look_around(const View& view) {
    std::vector<Eigen::Vector3f> out;
    // Equal steps of height are equal areas; the golden angle spreads them in azimuth.
    const double golden = pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < all_around; ++i)
        out.push_back(
            direction_of(golden * i, std::asin(part_centre(2.0, i, all_around))).cast<float>());
    for (int i = 0; i < across; ++i) {
        for (int k = 0; k < up_and_down; ++k) {
            if (view.shape == ViewShape::cone) {
                const double off = 0.5 * view.azimuth_rad * (k + 0.5) / up_and_down;
                const double turn = 2.0 * pi * i / across;
                out.push_back(direction_off_boresight(off, turn).cast<float>());
            } else {
                out.push_back(direction_of(part_centre(view.azimuth_rad, i, across),
                                           part_centre(view.elevation_rad, k, up_and_down))
                                  .cast<float>());
            }
        }
    }
    return out;
}

bool is_in_azimuth(const View& view, const Eigen::Vector3f& direction) {
    if (view.shape == ViewShape::cone) return direction.x() > 0.0F;
    return std::fabs(std::atan2(direction.y(), direction.x())) <= 0.5 * view.azimuth_rad;
}

}  // namespace sonarsim
