#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "paper/accumulate.h"
#include "sonar/sonar.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "validation/image_error.h"
#include "validation/reference.h"
#include "visibility/make_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

// Views that are coarser or narrower than those of usual sonars. Each failed when leaves followed
// only the beams: coarse views were off by 20 to 150 %, narrow ones were black.

namespace {

constexpr double relative_l1 = 0.03;

View fan(double azimuth_deg, double elevation_deg, double range_max_m, int bins, int beams) {
    return {radians(azimuth_deg), radians(elevation_deg), 0.5, range_max_m, bins, beams,
            relative_l1,          ViewShape::fan};
}

View cone(double opening_deg, double range_max_m, int bins) {
    const double opening = radians(opening_deg);
    return {opening, opening, 0.5, range_max_m, bins, 1, relative_l1, ViewShape::cone};
}

Ping octree_ping(const Scene& scene, const View& view, const Pose& pose) {
    Sonar sonar = test::noise_free(test::small_imaging());
    sonar.settings.view = view;
    test::fit_noise_to_view(sonar);
    return render_ping(sonar, scene, *make_octree_engine(scene, {}), pose, {1, 0});
}

double octree_error(const Scene& scene, const View& view, const Pose& pose) {
    const Caster caster(scene);
    const Reference truth = cast_reference(caster, scene, view, pose, {0.004, 64.0, 20'000'000});
    return image_error(octree_ping(scene, view, pose).intensity, truth.intensity).relative_l1;
}

}  // namespace

TEST_CASE("octree view: few wide beams, few long bins" * doctest::skip(test::sanitized)) {
    const Scene floor = test::rough_floor();
    const Scene tank = test::tank();
    const Pose above{rotation_from_rpy(0.1, 0.4, 0.7), {0.3, 0.2, 2.5}};
    const Pose inside{rotation_from_rpy(0.05, 0.3, 0.4), {-2.4, 0.4, 1.5}};
    CHECK(octree_error(floor, fan(100.0, 10.0, 18.0, 76, 2), above) < 0.08);
    CHECK(octree_error(floor, fan(45.0, 40.0, 12.0, 150, 8), above) < 0.08);
    CHECK(octree_error(floor, fan(120.0, 20.0, 18.0, 6, 3), above) < 0.08);
    CHECK(octree_error(tank, fan(30.0, 40.0, 5.0, 7, 1), inside) < 0.08);
    CHECK(octree_error(tank, fan(120.0, 20.0, 9.0, 200, 3), inside) < 0.08);
    CHECK(octree_error(tank, cone(30.0, 9.0, 12), inside) < 0.08);
}

TEST_CASE("octree view: the narrowest views see a wall") {
    // The plane through (5, 0, 0) with a normal 20 degrees off the boresight: v . n = cos(20
    // degrees) on the boresight, at a range of 5 m. At 30 degrees to starboard the ray meets the
    // plane 2.5 m from there, at 30 degrees to port 3.9 m: six metres to either side fill every
    // view.
    Scene scene = test::empty_scene();
    const auto material = test::add_material(scene, 0.5F);
    const auto across = static_cast<float>(6.0 * std::cos(radians(20.0)));
    const auto away = static_cast<float>(6.0 * std::sin(radians(20.0)));
    test::add_quad(scene, {5.0F - away, -across, -2.0F}, {5.0F + away, across, -2.0F},
                   {5.0F + away, across, 2.0F}, {5.0F - away, -across, 2.0F}, material);
    const auto truth = static_cast<float>(0.5 * std::cos(radians(20.0)));
    for (const View& view :
         {fan(0.001, 0.001, 10.0, 20, 1), fan(0.005, 0.13, 10.0, 20, 950),
          fan(0.1, 20.0, 10.0, 20, 100), fan(60.0, 0.1, 10.0, 20, 64), cone(0.001, 10.0, 20),
          cone(0.01, 10.0, 20), cone(0.13, 10.0, 20), cone(2.0, 10.0, 20)}) {
        CAPTURE(view.azimuth_rad);
        CAPTURE(view.elevation_rad);
        const Ping ping = octree_ping(scene, view, Pose{});
        int dark_beams = 0;
        for (int j = 0; j < view.beams; ++j) {
            float brightest = 0.0F;
            for (int i = 0; i < view.range_bins; ++i)
                brightest = std::max(brightest,
                                     ping.intensity[static_cast<std::size_t>(i) * view.beams + j]);
            dark_beams += brightest == 0.0F;
            if (view.azimuth_rad < 0.04) CHECK(brightest == test::approx(truth).epsilon(0.02));
        }
        CHECK(dark_beams == 0);
    }
}

TEST_CASE("octree view: a warning gives the expected error, and appears only above the goal") {
    const EngineSettings octree{EngineKind::octree, {}};
    View view = fan(60.0, 12.0, 10.0, 512, 256);
    CHECK(accuracy_warning(octree, view).empty());
    CHECK(accuracy_warning({EngineKind::octree, {.leaf_m = 0.02}}, view).empty());
    CHECK(accuracy_warning({EngineKind::octree, {.leaf_m = 0.5}}, view).find("octree.leaf_m") !=
          std::string::npos);
    CHECK(accuracy_warning({EngineKind::octree, {.leaf_m = 0.05}}, view) ==
          "engine: octree will be off by about 4.7 % in this view, more than accuracy.relative_l1 "
          "(3 %); use engine: rays or a smaller octree.leaf_m");
    view.relative_l1 = 0.01;
    CHECK(accuracy_warning(octree, view).empty());
    CHECK(accuracy_warning({}, view).empty());
    // With an opening of a hundredth of a degree, narrower than any leaf, 18 of 64 beams of the
    // wall above are dark.
    CHECK(accuracy_warning(octree, fan(60.0, 0.01, 10.0, 20, 64)).find("off by about 19.2 %") !=
          std::string::npos);
}

TEST_SUITE_END();
