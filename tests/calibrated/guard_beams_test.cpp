#include "simulate/reference/reference.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/view.h"
#include "support/calibrated.h"

namespace {

/// A line array that hears all elevations alike in beams of 60 degrees of azimuth.
Sonar line_array_sonar(double view_azimuth_deg) {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 1e6);
    set_fan(config, 60.0, 178.0, 64);
    set_range(config, 1.0, 3.0, 100);
    config.instrument.beam.view_azimuth_deg = view_azimuth_deg;
    return make_sonar(config, {0.005});
}

/// The expected image of a ball 2 m off in this direction.
std::vector<float> image_of_ball(const Sonar& sonar, double azimuth_rad, double elevation_rad) {
    const Eigen::Vector3d centre = 2.0 * direction_of(azimuth_rad, elevation_rad);
    return expected_image(sonar, sphere_scene(centre.cast<float>(), 0.1F, 0.4F), EngineKind::rays);
}

}  // namespace

TEST_CASE("beams are cones: a ball high up and far aside sounds as one at the same y / r") {
    // y / r = sin(azimuth) cos(elevation) is 0.3214 in both places.
    const double azimuth = radians(70.0);
    const double elevation = radians(70.0);
    const double same = arcsin(sincos(azimuth).sin * sincos(elevation).cos);
    const Sonar narrow = line_array_sonar(0.0);
    const Sonar wide = line_array_sonar(180.0);
    CHECK(narrow.settings.view.guards.count == 0);
    CHECK(wide.settings.view.guards.count == 64);
    const std::vector<float> ahead = image_of_ball(narrow, same, 0.0);
    CHECK(std::ranges::max(ahead) > 0.0F);
    CHECK(std::ranges::max(image_of_ball(narrow, azimuth, elevation)) == 0.0F);
    const std::vector<float> aside = image_of_ball(wide, azimuth, elevation);
    CHECK(image_error(aside, ahead).relative_l1 < 0.03);
    CHECK(image_error(image_of_ball(wide, same, 0.0), ahead).relative_l1 < 0.03);
    // Guard beams as wide as two bins, in the same 60 degrees to either side.
    Sonar coarse = wide;
    coarse.settings.view.guards = {.count = 32, .beam_rad = radians(60.0) / 32};
    CHECK(std::fabs(widened_view(coarse.settings.view).azimuth_rad - radians(180.0)) < 1e-9);
    CHECK(image_error(image_of_ball(coarse, azimuth, elevation), aside).relative_l1 < 0.02);
    CHECK(image_error(image_of_ball(coarse, -azimuth, elevation),
                      image_of_ball(wide, -azimuth, elevation))
              .relative_l1 < 0.02);
}

TEST_CASE("beams that the array does not resolve are traced two at a time at coarse goals") {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 1e6);
    set_range(config, 1.0, 5.0, 200);
    set_fan(config, 60.0, 60.0, 120);
    config.instrument.beam.width_deg = 1.0;
    const auto traced_beams = [&](double goal) {
        return traced_view(make_sonar(config, {goal}).settings.view).beams;
    };
    CHECK(traced_beams(0.03) == 60);
    CHECK(traced_beams(0.01) == 120);
    Scene scene = floor_scene(8.0F, -1.5F, 0.4F, 4);
    add_sphere(scene, {3.0F, 0.4F, -1.2F}, 0.3F, 0, 32);
    add_box(scene, {2.0F, -0.9F, -1.5F}, {2.4F, -0.3F, -0.8F}, 0);
    for (const double view_azimuth_deg : {0.0, 91.4}) {
        config.instrument.beam.view_azimuth_deg = view_azimuth_deg;
        const Sonar joined = make_sonar(config, {0.02});
        REQUIRE(joined.settings.view.guards.joined == 2);
        const auto engine = engine_of(scene, EngineKind::strips);
        const Samples samples = visible_surface(joined.settings.view, *engine, {});
        REQUIRE(std::ssize(samples.beam_begin) == joined.settings.view.beams + 1);
        CHECK(samples.in_no_beam().empty() == (view_azimuth_deg == 0.0));
        for (int j = 0; j < joined.settings.view.beams; j += 2) {
            CHECK(samples.beam(j).size() > 0);
            CHECK(samples.beam(j + 1).empty());
        }
        Sonar single = joined;
        single.settings.view.guards.joined = 1;
        const std::vector<float> by_two = expected_image(joined, scene, EngineKind::strips);
        const std::vector<float> by_one = expected_image(single, scene, EngineKind::strips);
        CHECK(image_error(by_two, by_one).relative_l1 < 0.03);
    }
}
