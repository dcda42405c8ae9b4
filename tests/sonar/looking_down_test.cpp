#include "simulate/product/soundings.h"
#include "support/sonars.h"

namespace {

SonarConfig echosounder() {
    SonarConfig config = default_sonar(SonarKind::echosounder);
    config.name = "sounder";
    config.range_bins = 950;  // 1 cm
    return config;
}

}  // namespace

// v . n = H / r at every point of the bottom. The cone of half-angle psi ends at H / cos psi, the
// swath of 170 degrees beyond the range.
TEST_CASE("echosounder, side-scan: a flat bottom echoes as R H / r over the view, from H on") {
    constexpr float R = 0.6F;
    const Scene scene = floor_scene(100.0F, 0.0F, R);
    SonarConfig towed = default_sonar(SonarKind::sidescan);
    set_range(towed, towed.range_min_m, 25.5, 500);  // 5 cm
    struct Case {
        SonarConfig config;
        double H, half_deg;
        int beams;
    };
    std::vector<Case> cases{{towed, 5.012, 85.0, 2}};
    const auto engine = engine_of(scene, EngineKind::strips);
    Uniform random(5);
    while (cases.size() < 20)
        cases.push_back({echosounder(), random.between(2.0, 9.3), 15.0, 1});
    for (const Case& one : cases) {
        const double H = one.H;
        const double end = H / std::cos(radians(one.half_deg));
        const Sonar sonar = make_sonar(one.config, {});
        const Ping ping = render_ping(sonar, scene, *engine, {.translation = {0, 0, H}}, {});
        REQUIRE(ping.beams == one.beams);
        for (int k = 0; k < ping.range_bins * ping.beams; ++k) {
            const int i = k / ping.beams;
            const double r = bin_centre(sonar, i);
            CAPTURE_ALL(H, k);
            if (sonar.range_edges_m[i + 1] <= H - 1e-5 || sonar.range_edges_m[i] > end)
                CHECK(ping.intensity[k] == 0.0F);
            if (r > H + 0.01 && r < end - 0.01)
                CHECK(ping.intensity[k] == approx(R * H / r).epsilon(0.01));
        }
    }
}

// Rolled to port by a, a sonar at the height H has its foot on the starboard side, at H. The point
// nearest to port lies on the border of the two, at H / cos a. A table hides the foot.
TEST_CASE("side-scan: the first return is that of the nearest bottom in view") {
    Scene scene = floor_scene(100.0F, 0.0F, 0.6F);
    scene.is_bottom = {1};
    const Sonar sonar = make_sonar(default_sonar(SonarKind::sidescan), {});
    const auto first = [&](const char* side) {
        const Pose vehicle{rotation_from_rpy(radians(20.0), 0.0, 0.0), {0.0, 0.0, 5.0}};
        const auto engine = engine_of(scene, EngineKind::strips);
        const TracedPing traced = trace(sonar, scene, *engine, vehicle, 0);
        const auto found = measured({sonar, vehicle, 0, {}, traced, scene.is_bottom}, *engine);
        return found.at("first_return_m").at(side).get<double>();
    };
    CHECK(first("starboard") == approx(5.0).epsilon(1e-3));
    CHECK(first("port") == approx(5.0 / std::cos(radians(20.0))).epsilon(1e-3));
    // Seen from 5 m, an edge 1 m off at 2.5 m of height hides the floor as far as 2 m off.
    scene.instances.emplace_back("table");
    add_rectangle(scene, {-9.0F, -1.0F, 2.5F}, {9.0F, 9.0F, 2.5F}, 0);
    CHECK(first("starboard") == approx(std::hypot(5.0, 2.0)).epsilon(0.01));
}

TEST_CASE("echosounder: range noise does not fade") {
    // A bottom within one scatterer cell: each ping draws one w, and the echo keeps its strength
    // wherever it lands; an imaging sonar's would be weaker by exp(-w / lambda).
    const Scene scene = floor_scene(100.0F, 0.0F, 0.8F);
    SonarConfig config = echosounder();
    config.opening_deg = 1.0;
    config.noise.range_lambda_m = 0.3;
    config.noise.scatterer_m = 1000.0;
    const Sonar sonar = make_sonar(config, {});
    double latest = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Ping ping = look(sonar, scene, {.translation = {0, 0, 3}}, {seed, 0});
        CHECK(std::ranges::max(ping.intensity) == approx(0.8).epsilon(1e-3));
        latest = std::max(latest, sonar.middle_m(first_return(ping.intensity).value()) - 3.0);
    }
    CHECK(latest > 0.2);  // the largest of 20 draws of mean 0.3 m; below 0.2 once in 10^6
}
