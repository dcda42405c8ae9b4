#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/model.h"
#include "simulate/trace/particles.h"
#include "support/labelled.h"
#include "support/patches.h"

namespace {

constexpr float section_m2 = 1e-4F;  // TS = -40 dB

TracedPing ping_of_points(const std::vector<Eigen::Vector3f>& places) {
    TracedPing traced;
    traced.samples.beam_begin = {0};
    for (const Eigen::Vector3f& place : places) {
        Sample point = point_facing(place, static_cast<double>(section_m2));
        point.kind = SampleKind::particle;
        point.number = static_cast<std::uint32_t>(traced.samples.items.size());
        traced.samples.items.push_back(point);
    }
    return traced;
}

/// The sum of a beam's bins by that of the pulse's taps: the power of the echo before the pulse.
double echo_of_beam(const CalibratedModel& model, const std::vector<float>& image, int beams,
                    int beam) {
    return total(image_array(image, beams).col(beam)) / total(model.power_taps.taps);
}

/// TS - 40 log r - 2 alpha r, as a ratio.
double equation(const CalibratedModel& model, double range_m) {
    return section_m2 / std::pow(range_m, 4) *
           power_of_db(-2.0 * model.absorption_db_per_m * range_m);
}

}  // namespace

// EL = SL + TS + D - 40 log r - 2 alpha r with SL = 0. The two-way pattern D of a disc is the
// fourth power of 2 J1(x) / x, x = k a sin(angle).
TEST_CASE("particles: the level of a target in an echosounder, at every place") {
    const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
    const CalibratedModel model =
        calibrated_model(instrument_of(Aperture::piston, 7.0, 0.5), {}, view, {});
    for (const double range_m : {4.0, 9.03, 17.5}) {
        for (const double off_deg : {0.0, 2.0, 3.5, 6.0}) {
            CAPTURE_ALL(range_m, off_deg);
            const double off = radians(off_deg);
            const Eigen::Vector3f place =
                (range_m *
                 Eigen::Vector3d(std::cos(off), 0.6 * std::sin(off), -0.8 * std::sin(off)))
                    .cast<float>();
            const std::vector<float> image =
                image_of_traced(model, view, ping_of_points({place}), {});
            const double pattern = piston_pattern(piston_scale(radians(7.0)) * std::sin(off));
            const double expected = equation(model, range_m) * std::pow(pattern, 4);
            CHECK(std::fabs(db_of_power(echo_of_beam(model, image, 1, 0) / expected)) < 0.005);
        }
    }
}

// In a fan the beam that looks at the target has all of it, within 0.2 dB by its place between two
// columns of the grid. In elevation the two-way pattern is half at half its width.
TEST_CASE("particles: the level of a target in the beam of a fan, and by elevation") {
    InstrumentConfig config = instrument_of(Aperture::line, 2.0, 0.1);
    config.beam.elevation_width_deg = 20.0;
    const View view = view_of(ViewShape::fan, 60.0, 40.0, 61);
    const CalibratedModel model = calibrated_model(config, {}, view, fan_sines(60.0, 61));
    const auto level = [&](double elevation_deg) {
        const Eigen::Vector3f place =
            (9.0 * direction_of(0.0, radians(elevation_deg))).cast<float>();
        const std::vector<float> image = image_of_traced(model, view, ping_of_points({place}), {});
        return db_of_power(echo_of_beam(model, image, 61, 30) / equation(model, 9.0));
    };
    CHECK(std::fabs(level(0.0)) < 0.17);
    CHECK(level(10.0) - level(0.0) == approx(db_of_power(0.5)).epsilon(0.02));
}

// With speckle a single target does not flicker, and two of one strength at one place add by
// their phases: the power is between 0 and 4 times that of one, |1 + exp(i phase)|^2.
TEST_CASE("particles: amplitudes keep their phases from ping to ping") {
    const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
    InstrumentConfig config = instrument_of(Aperture::piston, 7.0, 0.1);
    config.speckle.mode = SpeckleMode::scene;
    const CalibratedModel model = calibrated_model(config, {}, view, {});
    const auto peak = [&](const std::vector<Eigen::Vector3f>& places, std::uint32_t ping,
                          std::uint64_t seed) {
        return std::ranges::max(
            image_of_traced(model, view, ping_of_points(places), {}, {seed, 2, ping}));
    };
    const Eigen::Vector3f place{9.05F, 0.0F, 0.0F};
    const float one = peak({place}, 0, 7);
    CHECK(one == peak({place}, 5, 7));
    CHECK(one == approx(peak({place}, 0, 8)).epsilon(1e-5));
    // In the middle of a bin the amplitude is that of the pulse's middle tap.
    const std::vector<float>& taps = model.amplitude_taps.taps;
    const double middle = taps[taps.size() / 2];
    CHECK(one == approx(middle * middle * equation(model, 9.05)).epsilon(1e-4));
    double sum = 0.0;
    constexpr int seeds = 200;
    for (int seed = 0; seed < seeds; ++seed) {
        const float both = peak({place, place}, 0, static_cast<std::uint64_t>(seed));
        CHECK(both < 4.001F * one);
        sum += both / one;
    }
    // The mean of 2 + 2 cos(phase) is 2, its deviation sqrt(2): 4 sigma of 200 are 0.4.
    CHECK(sum / seeds == approx(2.0).epsilon(0.2));
}

// Targets are added eight at a time, in blocks of 256. What fills up the last eight has no
// echo. It had the amplitudes of the block before, in the first bins.
TEST_CASE("particles: nothing is added behind the last target of a block") {
    View view = view_of(ViewShape::fan, 20.0, 40.0, 5);
    view.range_bins = 2000;
    InstrumentConfig config = instrument_of(Aperture::line, 4.0, 0.01);
    config.speckle.mode = SpeckleMode::scene;
    const CalibratedModel model = calibrated_model(config, {}, view, fan_sines(20.0, 5));
    std::vector<Eigen::Vector3f> places;  // from 2.5 m on
    for (int k = 0; k < 300; ++k)
        places.emplace_back(2.5F + 0.06F * static_cast<float>(k), 0.0F, 0.0F);
    const std::vector<float> image = image_of_traced(model, view, ping_of_points(places), {});
    constexpr int before = 40 * 5;  // bins from 2.0 to 2.4 m
    CHECK(std::ranges::max(std::span(image).first(before)) < 1e-18F);
    CHECK(std::ranges::max(image) > 1e-7F);
}

// The object of the bins is the target, where it is stronger than the floor behind.
TEST_CASE("particles: labels at their bin and beam") {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 2e5);
    set_fan(config, 60.0, 20.0, 60);
    set_range(config, 2.0, 22.0, 200);
    Scene scene = rectangle_scene({15, -20, -10}, {15, 20, 10}, 0.4F);
    scene.instances.emplace_back("fish_1");
    scene.materials.push_back({.name = "fish"});
    Sonar sonar = make_sonar(config, {});
    const double azimuth = radians(10.5);
    const Particle fish{
        .start_m = 8.05 * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.02),
        .velocity_m_s = {0.0, 0.0, 0.0},
        .section_m2 = section_m2,
        .material = static_cast<std::uint32_t>(scene.materials.size() - 1),
        .instance = 1};
    sonar.settings.sources = {
        std::make_shared<const Particles>(std::vector<Particle>{fish}, std::vector<double>{})};
    const Labelled found = label(scene, sonar, {}, EngineKind::rays);
    const std::size_t at = found.at(bin_at(sonar, 8.05), 40);
    REQUIRE(found.labels.object[at] > 0);
    CHECK(found.objects.objects[found.labels.object[at] - 1U].name == "fish_1");
    CHECK(found.labels.share[at] == 1.0F);
    CHECK(found.labels.material[at] == fish.material + 1);
    CHECK(found.labels.elevation_rad[at] == approx(0.02).epsilon(0.02));
    // A beam and a bin have that label, cut by the borders of two of each.
    CHECK(std::ranges::count(found.labels.object, found.labels.object[at]) <= 9);
}
