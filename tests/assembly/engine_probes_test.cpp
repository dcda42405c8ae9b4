#include "assembly/engine_probes.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/units.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("assembly") {
    TEST_CASE("auto: a view of more than 90 degrees of elevation is traced by rays") {
        Mission mission = small_mission("out");
        mission.engine = EngineKind::automatic;
        for (SonarConfig& sensor : mission.sensors)
            sensor.multipath.method = MultipathMethod::none;
        for (const double elevation_deg : {90.0, 91.0, 150.0}) {
            mission.sensors[0].elevation_deg = elevation_deg;
            const EngineSettings settings = engine_settings(mission, small_assembly(mission, 9));
            const auto wide = [&](const Probe& probe) {
                return degrees(probe.view.elevation_rad) > 90.01;
            };
            const bool is_wide = elevation_deg > 90.0;
            CHECK(std::ranges::any_of(settings.probes, wide) == is_wide);
            for (const Probe& probe : settings.probes)
                CHECK((probe.rays.goal > 0.0) == wide(probe));
        }
    }
}
