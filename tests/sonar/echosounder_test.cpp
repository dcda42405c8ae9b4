#include "simulate/product/bottom.h"
#include "support/sonars.h"

namespace {

SonarConfig echosounder() {
    SonarConfig config = default_sonar(SonarKind::echosounder);
    config.name = "sounder";
    config.range_bins = 950;  // 1 cm
    return config;
}

double detected_depth(const Sonar& sonar, const Ping& ping) {
    return sonar.middle_m(first_return(ping.intensity).value());
}

}  // namespace

TEST_CASE("echosounder: a flat bottom echoes as R H / r over the cone, from its depth on") {
    // v . n = H / r at every point of the bottom; the cone of half-angle psi ends at H / cos psi.
    constexpr float R = 0.6F;
    const Scene scene = floor_scene(100.0F, 0.0F, R);
    const Sonar sonar = make_sonar(echosounder(), {});
    for (const double H : {2.003, 5.0, 9.017}) {
        const Ping ping = look(sonar, scene, {.translation = {0, 0, H}});
        REQUIRE(ping.beams == 1);
        const double bin_m = sonar.settings.view.bin_m();
        const double end = H / std::cos(radians(15.0));
        CAPTURE(H);
        CHECK(std::fabs(detected_depth(sonar, ping) - H) <= bin_m);
        for (int i = 0; i < ping.range_bins; ++i) {
            const double r = bin_centre(sonar, i);
            if (r < H - bin_m || r > end + bin_m) CHECK(ping.at(i, 0) == 0.0F);
            if (r > H + bin_m && r < end - bin_m)
                CHECK(ping.at(i, 0) == approx(R * H / r).epsilon(0.01));
        }
    }
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
        latest = std::max(latest, detected_depth(sonar, ping) - 3.0);
    }
    CHECK(latest > 0.2);  // the largest of 20 draws of mean 0.3 m; below 0.2 once in 10^6
}
