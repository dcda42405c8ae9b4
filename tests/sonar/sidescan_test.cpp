#include "simulate/product/sidescan.h"

#include "support/sonars.h"

namespace {

constexpr float R = 0.5F;   // reflection of the bottom
constexpr double H = 5.02;  // altitude, not at the edge of a bin

SonarConfig sidescan() {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    config.name = "sss";
    config.range_max_m = 25.5;
    config.range_bins = 500;  // 5 cm
    return config;
}

Scene flat_bottom() {
    return floor_scene(100.0F, 0.0F, R);
}

const Pose above_bottom{.translation = {0.0, 0.0, H}};

}  // namespace

TEST_CASE(
    "sidescan: a flat bottom first returns at its altitude, then I = R H / r, on both sides") {
    // v . n = H / r everywhere, whatever the weights. The swath of 170 degrees reaches
    // H / cos(85 deg) = 58 m, beyond the range.
    const Sonar sonar = make_sonar(sidescan(), {});
    const Ping ping = look(sonar, flat_bottom(), above_bottom);
    REQUIRE(ping.beams == 2);
    const int first = bin_at(sonar, H);
    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < first; ++i)
            CHECK(ping.at(i, side) == 0.0F);
        CHECK(ping.at(first, side) == approx(R).epsilon(0.01));
        for (int i = first + 1; i < ping.range_bins; ++i)
            CHECK(ping.at(i, side) == approx(R * H / bin_centre(sonar, i)).epsilon(0.01));
    }
    for (const int side : {Side::port, Side::starboard}) {
        const double range_m = first_return_m(sonar, ping, side).value();
        CHECK(std::fabs(range_m - H) <= sonar.settings.view.bin_m());
    }
}

TEST_CASE("sidescan: a box casts a shadow of length r h / (H - h) on its far side") {
    // The line over the edge at the ground distance y meets the bottom at y H / (H - h).
    constexpr double h = 1.0;
    constexpr double y = 6.0;
    Scene scene = flat_bottom();
    add_box(scene, {-1.0F, 5.0F, 0.0F}, {1.0F, static_cast<float>(y), static_cast<float>(h)},
            add_material(scene, 0.9F));
    const Sonar sonar = make_sonar(sidescan(), {});
    const Ping ping = look(sonar, scene, above_bottom);
    const double r = std::sqrt(y * y + (H - h) * (H - h));
    const double length = r * h / (H - h);
    int first = bin_at(sonar, r) + 1;
    while (ping.at(first, 1) > 0.0F)
        ++first;
    int last = first;
    while (ping.at(last, 1) == 0.0F)
        ++last;
    CHECK(std::fabs(sonar.range_edges_m[first] - r) <= 2.0 * sonar.settings.view.bin_m());
    CHECK(std::fabs(sonar.range_edges_m[last] - (r + length)) <= 2.0 * sonar.settings.view.bin_m());
    // Before the box, and on the other side, the bottom is occupied.
    CHECK(ping.at(bin_at(sonar, 6.5), 1) > 0.0F);
    for (int i = bin_at(sonar, H) + 1; i < ping.range_bins; ++i)
        CHECK(ping.at(i, 0) > 0.0F);
}

TEST_CASE("sidescan: a target to port is in the left half only; turned round, in the right") {
    const Scene scene = sphere_scene({0.0F, 8.0F, 1.0F}, 0.5F, 1.0F, 64);
    const Sonar sonar = make_sonar(sidescan(), {});
    const auto row = [&](double yaw) {
        const Pose pose{rotation_from_rpy(0.0, 0.0, yaw), above_bottom.translation};
        return record_values(kind_of(SonarKind::sidescan).record, sonar.config,
                             look(sonar, scene, pose).intensity, 0.0F);
    };
    const std::vector<float> there = row(0.0);
    const std::vector<float> back = row(pi);
    const std::size_t n = there.size() / 2;
    REQUIRE(n == 510);  // ten columns from nadir to range_min, 50 cm
    float left = 0.0F;
    float mirrored = 0.0F;
    for (std::size_t k = 0; k < n; ++k) {
        left += there[k];
        CHECK(there[n + k] == 0.0F);
        CHECK(back[k] == 0.0F);
        mirrored += std::fabs(back[2 * n - 1 - k] - there[k]);
    }
    CHECK(left > 0.0F);
    CHECK(mirrored < 0.02F * left);
    // Its near side is at sqrt(8^2 + (H - 1)^2) - 0.5 = 8.45 m; range grows to the left.
    std::size_t nearest = n - 1;
    while (there[nearest] == 0.0F)
        --nearest;
    CHECK(std::fabs(bin_centre(sonar, static_cast<int>(n - 1 - nearest) - 10) -
                    (std::hypot(8.0, H - 1.0) - 0.5)) <= 0.1);
}
