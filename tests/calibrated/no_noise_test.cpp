#include "support/calibrated.h"
#include "support/patches.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    TEST_CASE("levels: noise_db -300 is no noise, whatever the gain") {
        for (const SonarKind kind : {SonarKind::imaging, SonarKind::sidescan}) {
            SonarConfig config = bare_sonar(default_sonar(kind), 1e6);
            config.instrument.receiver.tvg_log = 40.0;
            config.instrument.receiver.tvg_absorption = true;
            for (const double source_db : {0.0, 200.0}) {
                config.instrument.source_level_db = source_db;
                set_range(config, 200.0, 400.0, 100);
                const Sonar sonar = make_sonar(config, {});
                const auto image = image_of_samples(calibrated_model_of(sonar), sonar.settings.view,
                                                    {}, {.random = 2});
                CAPTURE_ALL(name_of(kind), source_db);
                CHECK(std::ranges::max(image) == 0.0F);
                CHECK(std::ranges::max(calibrated_model_of(sonar).noise_values) == 0.0F);
            }
        }
    }
}
