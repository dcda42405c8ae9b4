#include "simulate/calibrated/levels.h"

#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/model.h"
#include "support/calibrated.h"
#include "support/patches.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

SonarConfig levels_sonar(SonarKind kind) {
    SonarConfig config = calibrated(default_sonar(kind), 1e5);
    config.azimuth_deg = kind == SonarKind::sidescan ? 170.0 : 40.0;
    config.elevation_deg = kind == SonarKind::sidescan ? 1.0 : 10.0;
    set_range(config, 1.0, 5.0, 200);
    config.azimuth_bins = 16;
    return config;
}

std::vector<float> image_of(const Sonar& sonar, const std::vector<Sample>& samples, bool noise) {
    Samples all;
    all.items = samples;
    const std::size_t random_terms = noise ? 2 : 1;  // speckle, then the receiver's noise
    return image_of_samples(calibrated_model_of(sonar), sonar.settings.view, all,
                            {.random = random_terms});
}

constexpr std::array kinds{SonarKind::imaging, SonarKind::sidescan, SonarKind::echosounder,
                           SonarKind::scanning};

}  // namespace

TEST_SUITE("calibrated") {
    // At 10 MHz two-way absorption is more than 150 dB from 2 to 4.5 m. After the gain both
    // echoes are equally strong.
    TEST_CASE("levels: gain makes up for absorption far below what e^-43 leaves") {
        SonarConfig config = levels_sonar(SonarKind::imaging);
        config.instrument.frequency_hz = 1e7;
        config.instrument.speckle.mode = SpeckleMode::none;
        const Sonar sonar = make_sonar(config, {});
        CHECK(2.0 * 4.5 * calibrated_model_of(sonar).absorption_db_per_m > 190.0);  // 10 lg e^43.7
        // Nearer than 2 m the plate is cut into points of several columns of the grid.
        const double near = total(image_of(sonar, {plate_ahead(2.0, 0.01)}, false));
        const double far = total(image_of(sonar, {plate_ahead(4.5, 0.01)}, false));
        CHECK(near > 0.0);
        // The gain is that of a bin's middle. An echo at a bin's edge is off by 2 alpha dr / 2.
        const double edge_db =
            calibrated_model_of(sonar).absorption_db_per_m * sonar.settings.view.bin_m();
        CHECK(std::fabs(db_of_power(far / near)) < edge_db);
    }

    TEST_CASE("levels: no legal level or range makes a value that is not finite") {
        std::mt19937 draw(25);
        const auto number = [&](double low, double high) {
            const auto which = draw() % 4;
            const double share = std::uniform_real_distribution<>(0.0, 1.0)(draw);
            return which == 0 ? low : which == 1 ? high : low + share * (high - low);
        };
        for (int trial = 0; trial < 100; ++trial) {
            SonarConfig config = levels_sonar(kinds[draw() % kinds.size()]);
            InstrumentConfig& instrument = config.instrument;
            set_range(config, 0.0, std::pow(10.0, number(-3.0, 9.0)), 32);
            instrument.frequency_hz = std::pow(10.0, number(3.0, 7.0));
            instrument.source_level_db = number(-300.0, 300.0);
            instrument.receiver.noise_db = number(-300.0, 300.0);
            instrument.receiver.full_scale_db = number(-300.0, 300.0);
            instrument.receiver.tvg_log = number(0.0, 60.0);
            instrument.receiver.tvg_from_m = number(0.0, 1.0) < 0.5 ? 0.0 : 1e9;
            instrument.speckle.mode = static_cast<SpeckleMode>(draw() % 3);
            const double range = number(0.001, 1.0) * config.range_max_m;
            const Sonar sonar = make_sonar(config, {});
            for (const bool noise : {false, true}) {
                CAPTURE(trial);
                CHECK(std::ranges::all_of(
                    image_of(sonar, {plate_ahead(range, 0.01)}, noise),
                    [](float value) { return value >= 0.0F && value <= max_value; }));
            }
        }
    }
}
