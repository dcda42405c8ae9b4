#include "assembly/engines.h"

#include <doctest/doctest.h>

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
            CHECK(settings.by_rays.empty() == (elevation_deg <= 90.0));
        }
    }

    TEST_CASE("auto: rays trace a sonar whose energies add") {
        Mission mission = small_mission("out");
        mission.engine = EngineKind::automatic;
        for (SonarConfig& sensor : mission.sensors)
            sensor.multipath.method = MultipathMethod::none;
        Assembly assembly = small_assembly(mission, 9);
        for (const bool energies_add : {false, true}) {
            for (Sonar& sonar : assembly.sonars)
                sonar.settings.view.energies_add = energies_add;
            CHECK((engine_settings(mission, assembly).type == EngineKind::rays) == energies_add);
        }
    }
}
