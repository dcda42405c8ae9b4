#include "simulate/lambert/lambert_model.h"
#include "simulate/paper/dropouts.h"
#include "simulate/trace/wake.h"
#include "support/patches.h"
#include "support/sonars.h"

// Runs the files that the examples of docs/development.md add. check_examples.py compiles them
// together with the lines that the examples change in lib.

namespace sonarsim {
KindOfSonar obstacle_kind();
}

TEST_CASE("example of a sonar: its record shows a wall ahead at its range") {
    const Scene scene = box_scene({7.03F, -50.0F, -50.0F}, {8.0F, 50.0F, 50.0F}, 0.6F);
    const KindOfSonar kind = obstacle_kind();
    SonarConfig config = kind.keys.defaults;
    const Sonar sonar = make_sonar(kind, config, {});
    const std::vector<float> row =
        record_values(kind.record, config, look(sonar, scene).intensity, 0.0F);
    REQUIRE(row.size() == kind.record.values(config));
    // Surface begins at 7.03 m and ends where the cone of half-angle 7.5 degrees does.
    const auto occupied = [](float value) { return value > 0.0F; };
    const auto first = std::ranges::find_if(row, occupied) - row.begin();
    const auto count = std::ranges::count_if(row, occupied);
    CHECK(first == bin_at(sonar, 7.03));
    CHECK(first + count - 1 == bin_at(sonar, 7.03 / std::cos(radians(7.5))));
    // The picture shows the brightest bin white.
    const StripFrame frame = kind.record.style.frame(config, 1);
    std::vector<Rgb> pixels(frame.width);
    kind.record.style.row(row, *std::ranges::max_element(row), frame, pixels);
    CHECK(pixels[std::ranges::max_element(row) - row.begin()] == Rgb{255, 255, 255});
    CHECK(pixels[0] == Rgb{0, 0, 0});
}

TEST_CASE("example of a stage: it loses a share of the beams, each by a draw of its own") {
    constexpr int beams = 512;
    constexpr int range_bins = 3;
    constexpr double share = 0.1;
    constexpr int pings = 40;
    int lost = 0;
    for (std::uint32_t ping = 0; ping < pings; ++ping) {
        const PhiloxKey key = stream_key(7, 1, ping, stream_named("dropouts"));
        std::vector<float> image(static_cast<std::size_t>(range_bins) * beams, 1.0F);
        const int own = drop_beams(image, beams, {static_cast<float>(share)}, key);
        CHECK(std::ranges::count(image, 0.0F) == range_bins * own);
        lost += own;
    }
    // The number of lost beams is binomial; 5 deviations are left in one of two million seeds.
    const double mean = pings * beams * share;
    CHECK(std::fabs(lost - mean) < 5.0 * std::sqrt(mean * (1.0 - share)));
}

TEST_CASE("example of a kind of sample: a wake absorbs and scatters") {
    // A sample 7 m ahead, 2 m of the way in the wake, loses e^(-2 a 2 m); one below the wake and a
    // wall that hides half of it change nothing else.
    const Scene scene = box_scene({4.0F, -50.0F, -50.0F}, {4.1F, 50.0F, 50.0F}, 0.6F);
    const auto engine = make_rays_engine(scene);
    const Wake wake({{Eigen::Vector3d(3, -1, -1), Eigen::Vector3d(5, 1, 1)}, 0.3F, 0.02F, 0.25},
                    SampleKind::particle);
    Samples samples;
    samples.items.resize(2);
    samples.items[0].position = {7.0F, 0.0F, 0.0F};
    samples.items[1].position = {0.0F, 0.0F, -7.0F};
    wake.add({View{}, scene, *engine, Pose{}}, {}, 0, samples);
    CHECK(samples.items[0].strength == approx(std::exp(-2 * 0.3 * 2)));
    CHECK(samples.items[1].strength == 1.0F);
    CHECK(area_of(std::span(samples.items).subspan(2)) == approx(0.02 * 1 * 2 * 2));
}

TEST_CASE("example of an echo model: the energy of a floor under a cone") {
    // With dA = r^2 dOmega / cos and r = H / cos, the sum of R cos^2 dA / r^4 over a cone of
    // half-angle a is R / H^2 times the integral of cos^3 dOmega, R / H^2 (pi / 2) (1 - cos^4 a).
    constexpr double H = 4.0;
    constexpr double R = 0.6;
    const Scene scene = floor_scene(100.0F, 0.0F, static_cast<float>(R));
    Sonar sonar = make_sonar(default_sonar(SonarKind::echosounder), {0.005});
    sonar.settings.model = std::make_shared<LambertModel>();
    const Ping ping = look(sonar, scene, {.translation = {0, 0, H}});
    const double cosine = std::cos(radians(15.0));
    CHECK(total(ping.intensity) ==
          approx(R / (H * H) * 0.5 * pi * (1.0 - std::pow(cosine, 4))).epsilon(0.01));
}
