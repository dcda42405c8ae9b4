#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "calibrated/decibel.h"
#include "calibrated/preset_fixtures.h"
#include "product/scan.h"
#include "sonar/setup.h"
#include "support/scenes.h"
#include "visibility/slices/slices_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The sonar of a preset with short pings and steps of half a degree over 24 degrees.
Sonar scanning(const std::string& preset) {
    return preset_sonar(
        preset,
        "    range_min_m: 1\n"
        "    range_max_m: 8\n"
        "    range_bins: 140\n"
        "    sector_deg: 24\n"
        "    step_deg: 0.5\n"
        "    instrument: {usual_water: none, speckle: {mode: none}, receiver: {tvg_log: 0}}\n");
}

/// The two-way loss of a point's level off the axis of the head: one way it is the array's pattern.
double loss_db(const LineArray& head, double off_rad) {
    return 4.0 * db_of_power(std::fabs(line_pattern(head, std::sin(off_rad))));
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("scanning: a point is smeared over the steps as the two-way beam is") {
        for (const char* const preset : {"micron", "ping360"}) {
            const Sonar sonar = scanning(preset);
            const LineArray head = array_of(sonar);
            const double width = radians(sonar.config.instrument.beam.width_deg);
            const double half_view = 0.5 * sonar.settings.view.azimuth_rad;
            const auto level = [&](double off) {
                const Pose pose{rotation_from_rpy(0.0, 0.0, off), Eigen::Vector3d::Zero()};
                const Samples point =
                    patches({5.0, 0.0, 0.0}, {0, -1, 0}, {0, 0, 1}, 0.002, 0.002, 0.002, pose);
                return db_of_power(total(quiet_image(sonar, point, false, pose)));
            };
            const double ahead = level(0.0);
            // At half of the width a quarter of the power is left.
            CHECK(std::fabs(level(0.5 * width) - ahead + 6.02) < 0.05);
            CHECK(std::fabs(level(-0.5 * width) - ahead + 6.02) < 0.05);
            int lobes = 0;
            for (const double angle : scan_angles_rad(sonar.config)) {
                if (std::fabs(angle) >= half_view) continue;
                const double expected = loss_db(head, angle);
                if (expected < -60.0) continue;  // in a null
                CHECK(std::fabs(level(angle) - ahead - expected) < 0.2);
                // The first side lobes are 20 dB down one way.
                lobes += std::fabs(angle) > 1.2 * width && expected > -41.0 ? 1 : 0;
            }
            CHECK(lobes >= 4);
        }
    }
}
