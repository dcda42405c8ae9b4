#include <doctest/doctest.h>

#include <algorithm>

#include "core/units.h"
#include "support/scenes.h"
#include "visibility/make_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

// An engine makes what covered_bins() needs when it is made, or at the call if nobody asked for it.
// A floor 2 m below covers the bins from there to the range of its farthest corner in view.
TEST_CASE("coverage: the same whether it was asked for at the start or not") {
    Scene scene = test::empty_scene();
    test::add_floor(scene, 20.0F, 0.0F, test::add_material(scene, 0.5F), 16);
    const View view{radians(60.0), radians(60.0), 0.5, 10.0, 100, 8, 0.03};
    const Pose pose{rotation_from_rpy(0.0, radians(60.0), 0.0), {0.0, 0.0, 2.0}};
    std::vector<std::uint8_t> first;
    for (const EngineKind type :
         {EngineKind::automatic, EngineKind::rays, EngineKind::slices}) {
        for (const bool coverage : {true, false}) {
            EngineSettings settings{.type = type, .octree = {}};
            settings.coverage = coverage;
            const auto engine = make_engine(scene, settings);
            const std::vector<std::uint8_t> covered = engine->covered_bins(view, pose);
            REQUIRE(covered.size() == 800);
            if (first.empty()) first = covered;
            CHECK(covered == first);
        }
    }
    // Bins are 9.5 cm: the floor straight below is in bin (2 - 0.5) / 0.095 = 15. Towards the
    // horizon the view ends 30 degrees below it, at a range of 2 / sin(30 degrees) = 4 m, bin 36.
    const auto middle = first.begin() + 4 * 100;
    CHECK(std::count(middle, middle + 15, 1) == 0);
    CHECK(std::count(middle + 16, middle + 36, 1) == 20);
    CHECK(std::count(middle + 40, middle + 100, 1) == 0);
}

TEST_SUITE_END();
