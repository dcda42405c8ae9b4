#include "support/labelled.h"

namespace {

Sonar height_sonar(double elevation_deg = 40.0) {
    SonarConfig config = small_imaging();
    config.elevation_deg = elevation_deg;
    return noise_free(config, 0.01);
}

std::vector<float> heights(const Scene& scene, const Sonar& sonar, const Pose& pose,
                           EngineKind type, const Bottom* bottom) {
    return label(scene, sonar, pose, type, {.height = true, .bottom = bottom}).labels.height_m;
}

/// 2 m above the floor, 20 degrees down.
const Pose down = pitched(20.0, {0.0, 0.0, 2.0});

}  // namespace

TEST_CASE("labels: the elevation of a floor is that of its range") {
    // At height H over a plane, level, straight ahead: sin(theta) = -H / r. Over a bin of width b
    // theta spreads evenly over b d(theta)/dr, a standard deviation of that over sqrt(12).
    Scene scene = floor_scene(100.0F, 0.0F, 0.6F);
    const Sonar sonar = height_sonar();
    constexpr double H = 2.0;
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, {.translation = {0, 0, H}}, type);
        int bins = 0;
        for (int i = bin_at(sonar, 6.5); i < bin_at(sonar, 9.5); ++i) {
            const double r = bin_centre(sonar, i);
            for (int j = 0; j < out.labels.beams; ++j) {
                const float theta = out.labels.elevation_rad[out.at(i, j)];
                const double truth = -std::asin(H / r);
                const double slope = H / (r * std::sqrt(r * r - H * H));
                const double spread = slope * sonar.settings.view.bin_m() / std::sqrt(12.0);
                ++bins;
                CHECK(std::fabs(theta - truth) < 0.5 * slope * sonar.settings.view.bin_m());
                const double stated = out.labels.elevation_spread_rad[out.at(i, j)] / spread;
                CHECK(stated > 0.0);
                CHECK(stated < 2.0);
            }
        }
        CHECK(bins > 1000);
        CHECK(std::isnan(out.labels.elevation_rad[out.at(0, 0)]));
    }
}

TEST_CASE("labels: heights above the bottom, of a box, of a ramp and of the bottom itself") {
    // The sonar sees the floor from 3.1 m on. Straight ahead stands a box, half a metre high, from
    // x = 4 to 5 m: its top lies at 4.27 to 5.22 m, and it hides the floor up to 6.96 m. A ramp
    // from (8, 0) to (9, 0.5) lies at 8.25 to 9.12 m and hides the floor up to 12.17 m.
    Scene scene = floor_scene(100.0F, 0.0F, 0.5F);
    add_rectangle(scene, {4, -3, 0.5F}, {5, 3, 0.5F}, 0);
    add_rectangle(scene, {4, -3, 0}, {4, 3, 0.5F}, 0);
    add_quad(scene, {8, -6, 0}, {9, -6, 0.5F}, {9, 6, 0.5F}, {8, 6, 0}, 0);
    // The bottom is the floor up to x = 14 m, as a slab: its underside, and a roof, do not count.
    Surface slab;
    for (const double z : {-1.0, 0.0, 5.0}) {
        const auto first = static_cast<std::uint32_t>(slab.vertices.size());
        for (const auto& [x, y] :
             {std::pair{-1.0, -50.0}, {14.0, -50.0}, {14.0, 50.0}, {-1.0, 50.0}})
            slab.vertices.emplace_back(x, y, z);
        slab.triangles.push_back({first, first + 1, first + 2});
        slab.triangles.push_back({first, first + 2, first + 3});
    }
    const Bottom bottom(slab);
    SonarConfig config = small_imaging();
    config.elevation_deg = 40.0;
    set_range(config, config.range_min_m, 18.0, 512);
    const Sonar sonar = noise_free(config, 0.01);
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const std::vector<float> height = heights(scene, sonar, down, type, &bottom);
        int bins = 0;
        for (int j = 0; j < sonar.settings.view.beams; ++j) {
            // Beams near the middle, in which azimuth changes no range by more than half a bin.
            if (std::fabs(sonar.azimuth_edges_rad[j]) > 0.04) continue;
            const auto between = [&](double from, double to, const auto& check) {
                for (int i = bin_at(sonar, from); i < bin_at(sonar, to); ++i, ++bins) {
                    CAPTURE(sonar.range_edges_m[i]);
                    check(height[static_cast<std::size_t>(j) * config.range_bins + i],
                          bin_centre(sonar, i));
                }
            };
            between(3.3, 4.1, [](float h, double) { CHECK(h == 0.0F); });
            between(4.6, 5.1, [](float h, double) { CHECK(std::fabs(h - 0.5F) < 1e-4F); });
            between(5.4, 6.8, [](float h, double) { CHECK(std::isnan(h)); });  // a shadow
            between(7.2, 8.1, [](float h, double) { CHECK(h == 0.0F); });
            between(8.35, 9.0, [](float h, double r) {
                // At x = 8 + s and z = s / 2: r^2 = (8 + s)^2 + (2 - s / 2)^2
                //     = 68 + 14 s + 1.25 s^2.
                const double s = (-14.0 + std::sqrt(196.0 - 5.0 * (68.0 - r * r))) / 2.5;
                CHECK(std::fabs(h - 0.5 * s) < 0.02);
            });
            between(12.6, 13.8, [](float h, double) { CHECK(h == 0.0F); });
            between(14.5, 17.0, [](float h, double) { CHECK(std::isnan(h)); });  // no bottom
        }
        CHECK(bins > 500);
        CHECK(std::ranges::all_of(heights(scene, sonar, down, type, nullptr),
                                  [](float h) { return std::isnan(h); }));
    }
}

TEST_CASE("labels: a wall on the border of the bottom has heights") {
    // 6 m ahead of a sonar that looks level, which first sees the middle of it.
    const Scene scene = rectangle_scene({6, -9, 0}, {6, 9, 5}, 0.5F);
    const Bottom bottom({{{-1, -9, 0}, {6, -9, 0}, {6, 9, 0}, {-1, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    const Sonar sonar = height_sonar(20.0);
    const Pose pose{.translation = {0, 0, 2}};
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled visible = label(scene, sonar, pose, type);
        const std::vector<float> height = heights(scene, sonar, pose, type, &bottom);
        int occupied = 0;
        for (std::size_t k = 0; k < height.size(); ++k) {
            REQUIRE(std::isnan(height[k]) == std::isnan(visible.labels.elevation_rad[k]));
            if (std::isnan(height[k])) continue;
            ++occupied;
            // Surface as far above the sonar as below it falls into one bin.
            CHECK(std::fabs(height[k] - 2.0F) < 0.2F);
        }
        CHECK(occupied > 50);
    }
}

TEST_CASE("labels: surface of the bottom has the same height with and without a search") {
    // A floor and a wall that are the bottom, and a box on it.
    Scene scene = floor_scene(20.0F, 0.0F, 0.5F);
    add_rectangle(scene, {8, -9, 0}, {8, 9, 5}, 0);
    Surface surface;
    for (const Eigen::Vector3f& vertex : scene.vertices)
        surface.vertices.push_back(vertex.cast<double>());
    surface.triangles = scene.triangles;
    const Bottom bottom(surface);
    add_rectangle(scene, {4, -3, 0.5F}, {5, 3, 0.5F}, 0);
    const Sonar sonar = height_sonar();
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        scene.is_bottom.clear();
        const std::vector<float> searched = heights(scene, sonar, down, type, &bottom);
        scene.is_bottom = {1, 1, 0};
        const std::vector<float> known = heights(scene, sonar, down, type, &bottom);
        int wall_bins = 0;
        for (std::size_t k = 0; k < known.size(); ++k) {
            CHECK(std::isnan(known[k]) == std::isnan(searched[k]));
            if (std::isnan(known[k])) continue;
            CHECK(std::fabs(known[k] - searched[k]) < 1e-4F);
            wall_bins += known[k] > 1.0F ? 1 : 0;
        }
        CHECK(wall_bins > 20);
    }
}
