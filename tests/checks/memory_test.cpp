#include <doctest/doctest.h>

#include "checks/find_warnings.h"
#include "sonar/kinds.h"
#include "sonar/sonar.h"

using namespace sonarsim;

namespace {

SonarConfig line_array() {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.name = "fls";
    config.model = ModelKind::calibrated;
    config.azimuth_deg = 30.0;
    config.azimuth_bins = 64;
    config.range_bins = 128;
    return config;
}

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("memory: the key that would bring it down is what takes most") {
        SonarConfig config = line_array();
        CHECK(ping_memory(make_sonar(config, {})).key == "range_bins");
        config.azimuth_bins = 512;
        CHECK(ping_memory(make_sonar(config, {})).key == "azimuth_bins");
        config = line_array();
        config.instrument.beam.view_azimuth_deg = 180.0;
        CHECK(ping_memory(make_sonar(config, {})).key == "instrument.beam.view_azimuth_deg");
    }

    TEST_CASE("memory: guard beams narrower than the array resolves take no more") {
        SonarConfig config = line_array();
        config.azimuth_deg = 1.0;
        config.azimuth_bins = 512;
        config.instrument.beam.view_azimuth_deg = 179.0;
        // The array resolves a degree with 2.7 columns: 2 x 237 beams, not 91,136.
        const Sonar sonar = make_sonar(config, {});
        CHECK(sonar.settings.guard_beams.count > 200);
        CHECK(sonar.settings.guard_beams.count < 280);
        CHECK(ping_memory(sonar).bytes < 1e8);
    }

    TEST_CASE("memory: W26 where pings on all threads have no room") {
        const std::vector<Sonar> sonars{make_sonar(line_array(), {})};
        const double one = ping_memory(sonars[0]).bytes;
        CHECK(memory_warnings(sonars, 4, 4.0 * one).empty());
        CHECK(!exceeds_memory(sonars, one));
        const std::vector<Warning> found = memory_warnings(sonars, 4, 3.9 * one);
        REQUIRE(found.size() == 1);
        CHECK(sentence(found[0]).starts_with("W26 sensor 'fls': a ping takes about"));
        CHECK(found[0].cure.starts_with("lower range_bins"));
        CHECK(exceeds_memory(sonars, 0.9 * one));
    }
}
