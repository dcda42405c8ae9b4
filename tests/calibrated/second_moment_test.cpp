#include "calibrated/preset_fixtures.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double resolution_m = 0.02;
constexpr double width_deg = 0.3;
constexpr double range_m = 5.0;
constexpr double grazing_deg = 30.0;

/// 20 degrees of a fan, beams a width apart and bins of half a pulse, from 3.8 to 6.2 m.
Sonar fan() {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 1.8e6);
    config.azimuth_deg = 20.0;
    config.azimuth_bins = 66;
    config.range_min_m = range_m - 60.0 * resolution_m;
    config.range_max_m = range_m + 60.0 * resolution_m;
    config.range_bins = 240;
    config.instrument.beam.width_deg = width_deg;
    config.instrument.pulse.resolution_m = resolution_m;
    return make_sonar(config, {});
}

/// A plane of rock that sound meets at 30 degrees, straight ahead and all over the view.
Samples floor_of_rock() {
    const double c = std::cos(radians(grazing_deg));
    return patches({range_m, 0.0, 0.0}, {c, 0.0, std::sin(radians(grazing_deg))}, {0.0, 1.0, 0.0},
                   66.0 * 1.1 * resolution_m / c, 0.2 * range_m, 0.004 * range_m);
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("speckle: the second moment of scatterers, and their mean") {
        const Samples surface = floor_of_rock();
        const Sonar sonar = fan();
        const std::vector<float> expected = quiet_image(sonar, surface, false);
        constexpr int beams = 66;
        std::vector<double> means, seconds;
        for (std::uint32_t seed = 1; seed <= 20; ++seed) {
            const std::vector<float> image = quiet_image(sonar, surface, true, {}, seed);
            std::vector<double> powers, squares;
            for (int i = 20; i < 220; ++i) {
                for (int j = 8; j < beams - 8; ++j) {
                    powers.push_back(image[i * beams + j] / expected[i * beams + j]);
                    squares.push_back(powers.back() * powers.back());
                }
            }
            means.push_back(mean(powers));
            seconds.push_back(mean(squares));
        }
        // Sums of Gaussian amplitudes have 2. One scatterer of exponential strength s in each cell
        // of a lattice adds the sum over cells of E[s^2] a integral of w^2 - 2 (integral of w)^2,
        // by (integral of w)^2: 0.058 at this beam and pulse, a the area of a cell and w the power
        // of pulse and beam. 4.5 standard errors of 20 seeds: two such tests fail once in 2,000
        // runs. The spline that stands for the pulse adds a hundredth.
        CHECK(std::fabs(mean(means) - 1.0) < 4.5 * standard_error(means));
        CHECK(std::fabs(mean(seconds) - 2.058) < 4.5 * standard_error(seconds) + 0.01 * 2.058);
    }
}
