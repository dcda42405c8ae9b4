#include "simulate/labels/labels.h"

#include "support/bounces.h"
#include "support/labelled.h"

TEST_CASE("labels: a panel before a wall, its shadow, and water that is open") {
    // The panel covers the azimuths up to atan(0.5 / 3) at 3 m; the wall stands at 6 m, |y| < 2.
    Scene scene = rectangle_scene({6, -2, -5}, {6, 2, 5}, 0.5F);
    add_rectangle(scene, {3, -0.5F, -5}, {3, 0.5F, 5}, 0);
    const Sonar sonar = noise_free(small_imaging());
    const double panel = std::atan2(0.5, 3.0);
    const double wall = std::atan2(2.0, 6.0);
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, Pose{}, type);
        // Solid angles of the same elevations are as their azimuths.
        REQUIRE(out.labels.visible_share.size() == 2);
        CHECK(out.labels.visible_share[0] == approx(1.0 - panel / wall).epsilon(0.02));
        CHECK(out.labels.visible_share[1] == 1.0F);
        for (int j = 0; j < out.labels.beams; ++j) {
            const double a = sonar.azimuth_edges_rad[j];
            const double b = sonar.azimuth_edges_rad[j + 1];
            const double low = std::min(std::fabs(a), std::fabs(b));
            const double high = std::max(std::fabs(a), std::fabs(b));
            const bool straight = high < panel - 0.02;
            const bool beside = low > panel + 0.02 && high < wall - 0.02;
            if (!straight && !beside && low < wall + 0.02) continue;
            // The nearest bins of either that are occupied whole.
            const double to_edge = 1.0 / std::cos(0.5 * (low + high));
            const std::size_t near = out.at(bin_at(sonar, 3.0 * to_edge + 0.005), j);
            const std::size_t far = out.at(bin_at(sonar, 6.0 * to_edge + 0.01), j);
            const std::size_t water = out.at(bin_at(sonar, 4.5), j);
            CHECK(out.labels.object[near] == (straight ? 2 : 0));
            CHECK(out.labels.object[far] == (beside ? 1 : 0));
            CHECK(out.labels.shadow[far] == (straight ? 2 : 0));
            CHECK(out.labels.shadow[near] == 0);
            CHECK(out.labels.object[water] == 0);
            CHECK(out.labels.shadow[water] == 0);
            if (beside) {
                CHECK(out.labels.share[far] == 1.0F);
                CHECK(out.labels.second[far] == 0);
                CHECK(out.labels.class_id[far] == 1);
                CHECK(out.labels.material[far] == 1);
            }
        }
    }
}

TEST_CASE("labels: the visible share of a narrow wall behind ground that hides its foot") {
    // 1.2 m above ground of two triangles. Angles of elevation; the view ends above the foot.
    const ObjectSphere sphere{{5, 0, -0.7}, 1.0};
    const LabelRequest request{.annotations = true, .annotated = {&sphere, 1}};
    for (const double foot_m : {0.05, 0.1, 0.2}) {
        Scene scene = rectangle_scene({-1, -30, -1.2F}, {30, 30, -1.2F}, 0.5F);
        add_rectangle(scene, {5, -0.2F, static_cast<float>(-1.2 - foot_m)}, {5, 0.2F, -0.2F}, 0);
        for (const double pitch_deg : {17.5, 18.0, 18.5, 19.0}) {
            const double top = radians(6.0 - pitch_deg);
            const double free = (top + std::atan(1.2 / 5)) / (top + std::atan((1.2 + foot_m) / 5));
            const Labelled out = label(scene, noise_free(small_imaging()), pitched(pitch_deg),
                                       EngineKind::automatic, request, objects_on_floor(scene));
            CHECK(out.labels.visible_share[1] == approx(free).epsilon(0.1));
        }
    }
}

TEST_CASE("labels: what lies above the water's surface counts in no visible share") {
    Scene scene = rectangle_scene({6, -1, -1}, {6, 1, 1}, 0.5F);
    add_rectangle(scene, {3, -1, 0.05F}, {3, 1, 1}, 0);  // before z > 0.6 m of the wall
    scene.bounds_max = {6, 1, 1};
    SonarConfig config = small_imaging();
    config.elevation_deg = 40.0;
    for (const bool is_dry : {true, false}) {
        scene.water_surface = WaterSurface{is_dry ? 0.0 : 5.0};
        const Labelled out =
            label(scene, noise_free(config), {.translation = {0, 0, -0.5}}, EngineKind::automatic,
                  {.annotations = true, .annotated = {&anywhere, 1}});
        CHECK(out.labels.visible_share[0] == approx(is_dry ? 1.0 : 0.8).epsilon(0.03));
    }
}

TEST_CASE("labels: the visible share of thin bars behind a panel") {
    // Along y or z at x = 6 m; the panel is at 3 m. The solid angle of a bar from a to b is as
    // b / sqrt(36 + b^2) - a / sqrt(36 + a^2).
    const auto part = [](float a, float b) { return b / std::hypot(6, b) - a / std::hypot(6, a); };
    const auto off = [&](Scene scene, const Eigen::Vector3f& panel, float hidden_to, float end) {
        add_rectangle(scene, {3, -2, -2}, panel, 0);
        const Labelled out = label(scene, noise_free(small_imaging()), {}, EngineKind::automatic,
                                   {.annotations = true, .annotated = {&anywhere, 1}});
        return out.labels.visible_share[0] - part(hidden_to, end) / part(-end, end);
    };
    for (const float half : {0.005F, 0.01F, 0.02F}) {
        for (const float hidden : {-1.0F, 0.2F, 1.2F}) {
            const Scene along_y = rectangle_scene({6, -2, -half}, {6, 2, half}, 0.5F);
            CHECK(std::fabs(off(along_y, {3, 0.5F * hidden, 1}, hidden, 2)) < 0.05);
            const float top = 0.25F * hidden;
            const Scene along_z = rectangle_scene({6, -half, -0.5F}, {6, half, 0.5F}, 0.5F);
            CHECK(std::fabs(off(along_z, {3, 1, 0.5F * top}, top, 0.5F)) < 0.15);
        }
    }
}

TEST_CASE("labels: two things in one bin share its echo by area and reflection") {
    // Two equal panels face on at 5 m: shares are as their reflections, 0.6 and 0.2.
    Scene scene = rectangle_scene({5, -9, -9}, {5, 9, 0}, 0.2F);
    add_rectangle(scene, {5, -9, 0}, {5, 9, 9}, add_material(scene, 0.6F));
    const Sonar sonar = noise_free(small_imaging());
    for (const EngineKind type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, Pose{}, type);
        double occupied = 0.0;
        double agree = 0.0;
        double share = 0.0;
        for (std::size_t k = 0; k < out.labels.size(); ++k) {
            if (out.labels.object[k] == 0) continue;
            ++occupied;
            agree += out.labels.object[k] == 2 && out.labels.second[k] == 1;
            share += out.labels.share[k];
            CHECK(out.labels.share[k] + out.labels.second_share[k] == approx(1.0).epsilon(1e-5));
        }
        REQUIRE(occupied > 100.0);
        CHECK(agree / occupied > 0.98);
        CHECK(share / occupied == approx(0.75).epsilon(0.02));
    }
}

TEST_CASE("labels: occupied bins are those of the clean image, multipath bins its ghosts") {
    const Scene scene = tank();
    SonarConfig config = small_imaging();
    config.multipath.method = MultipathMethod::cluster;
    const Sonar sonar = noise_free(config);
    const auto engine = make_engine(scene, {});
    const SceneObjects objects = group_objects(scene, {});
    std::uint64_t ghosts = 0;
    std::uint64_t shadows = 0;
    for (const Pose& pose : tank_poses()) {
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        const auto label_as = [&](const LabelRequest& request) {
            return label_ping(traced, sonar.settings, scene, objects, *engine, request);
        };
        const PingLabels labels = label_as(everything);
        const Ping clean = form_image(traced, sonar.settings, scene, {}, without_random_terms);
        const Ping direct = form_image(traced, sonar.settings, scene, {}, direct_echoes_alone);
        for (int j = 0; j < clean.beams; ++j) {
            for (int i = 0; i < clean.range_bins; ++i) {
                const std::size_t k = static_cast<std::size_t>(j) * clean.range_bins + i;
                REQUIRE((labels.object[k] > 0) == (clean.at(i, j) > 0.0F));
                shadows += labels.shadow[k] > 0;
                if (labels.object[k] == 0) continue;
                REQUIRE(labels.share[k] >= labels.second_share[k]);
                if (direct.at(i, j) == 0.0F) {
                    REQUIRE(labels.multipath[k] == 1.0F);
                    ++ghosts;
                }
                if (labels.shadow[k] > 0) REQUIRE(direct.at(i, j) == 0.0F);
            }
        }
        // Asked for alone, shadows take another way to the bins that are occupied.
        const PingLabels alone = label_as({.shadow = true});
        CHECK(alone.shadow == labels.shadow);
        CHECK(alone.visible_share.size() == objects.objects.size());
        CHECK(alone.object.empty());
    }
    CHECK(ghosts > 0);
    CHECK(shadows > 0);
}

TEST_CASE("labels: in the tank the objects are those that rays without number find" *
          doctest::skip(sanitized)) {
    const Scene scene = tank();
    SonarConfig config = small_imaging();
    config.range_bins = 512;
    set_fan(config, 60.0, 40.0, 128);
    const Sonar sonar = noise_free(config, 0.01);
    const SceneObjects objects = group_objects(scene, {});
    const std::size_t count = objects.objects.size();
    const View& view = sonar.settings.view;
    for (const Pose& pose : tank_poses()) {
        // The echo of each object in each bin, [beams, range bins, objects], by rays alone: a ray
        // at `theta` has one of reflection times r^2 cos(theta). Each falls into one bin.
        std::vector<double> echoes(static_cast<std::size_t>(view.beams) * view.range_bins * count);
        follow_rays(scene, sonar, pose, {12, 2000}, 1,
                    [&](std::size_t bin, double theta, int, double r, const Intersection& met) {
                        echoes[bin * count + objects.object_of(met.instance)] +=
                            scene.materials[met.material].reflection * r * r * std::cos(theta);
                    });
        for (const EngineKind type : engine_types) {
            CAPTURE(static_cast<int>(type));
            const Labelled out = label(scene, sonar, pose, type);
            double occupied = 0.0;
            double same = 0.0;
            double unexplained = 0.0;
            for (std::size_t bin = 0; bin < out.labels.size(); ++bin) {
                const double* const echo = &echoes[bin * count];
                const double* const loudest = std::max_element(echo, echo + count);
                if (total(std::span(echo, count)) == 0.0 || out.labels.object[bin] == 0) continue;
                ++occupied;
                const auto stated = static_cast<std::size_t>(out.labels.object[bin]) - 1;
                same += loudest == echo + stated;
                // Another object is named only where both are there, or at the edge of a bin, where
                // a footprint reaches over: then a neighbour has it.
                bool near = echo[stated] > 0.0;
                for (const int step : {-1, 1, -view.range_bins, view.range_bins}) {
                    const std::ptrdiff_t next = static_cast<std::ptrdiff_t>(bin) + step;
                    if (next < 0 || next >= static_cast<std::ptrdiff_t>(out.labels.size()))
                        continue;
                    near = near || echoes[static_cast<std::size_t>(next) * count + stated] > 0.0;
                }
                unexplained += !near;
            }
            REQUIRE(occupied > 500.0);
            CHECK(same / occupied > 0.99);
            CHECK(unexplained / occupied < 0.001);
        }
    }
}
