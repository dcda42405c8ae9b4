// Labels of the calibrated model: where its beams, which are cones, receive the echo.

#include "labels/cone_fan.h"

TEST_CASE("cone labels: the pieces of targets cover the bins that an engine's samples cover") {
    Uniform draw(27);
    const Sonar sonar = wide_fan(spacings[0]);
    for (int n = 0; n < (sanitized ? 3 : 20); ++n) {
        CAPTURE(n);
        const Eigen::Vector3d middle =
            draw.between(3.0, 6.0) *
            direction_of(radians(draw.between(-35.0, 35.0)), radians(draw.between(-30.0, 30.0)));
        Scene scene = sphere_scene(middle.cast<float>(), draw.single(0.15, 0.4), 0.4F, 48);
        scene.materials[0].slope_rms_deg = 5.0;
        Sonar with_targets = sonar;
        find_targets({&with_targets, 1}, scene);
        const auto labels_of = [&](const Sonar& by) {
            const Labelled found = label(scene, by, {}, EngineKind::strips, {.objects = true});
            const bool has_pieces = std::ranges::count(found.traced.samples.items,
                                                       SampleKind::target, &Sample::kind) > 0;
            CHECK(has_pieces == (&by == &with_targets));
            return found.labels;
        };
        const PingLabels by_engine = labels_of(sonar);
        const PingLabels by_pieces = labels_of(with_targets);
        double both = 0.0;
        double either = 0.0;
        for (std::size_t at = 0; at < by_engine.size(); ++at) {
            const bool a = by_engine.object[at] > 0;
            const bool b = by_pieces.object[at] > 0;
            both += a && b ? 1.0 : 0.0;
            either += a || b ? 1.0 : 0.0;
        }
        CHECK(either > 50.0);
        CHECK(both / either > 0.9);
    }
}

TEST_CASE("cone labels: objects alone have the bins and shadows that they have beside background") {
    Uniform draw(58);
    for (int n = 0; n < (sanitized ? 2 : 12); ++n) {
        CAPTURE(n);
        Scene scene = floor_scene(20.0F, -2.0F, 0.4F);
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f low(static_cast<float>(draw.between(1.0, 7.0)),
                                      static_cast<float>(draw.between(-4.0, 4.0)), -2.0F);
            const auto size = static_cast<float>(draw.between(0.05, 0.8));
            add_box(scene, low, low + Eigen::Vector3f(size, 2.0F * size, size), 0);
        }
        const Sonar sonar = wide_fan(spacings[n % std::size(spacings)]);
        const Pose pose = pitched(draw.between(10.0, 40.0));
        const SceneObjects objects = objects_on_floor(scene);
        const auto engine = make_engine(scene, {});
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        LabelRequest request{.objects = true, .annotations = true};
        request.annotated = {&anywhere, 1};
        const auto labels = [&](bool alone) {
            request.only_objects = alone;
            return label_ping(traced, sonar.settings, scene, objects, *engine, request);
        };
        const PingLabels all = labels(false);
        const PingLabels alone = labels(true);
        CHECK(alone.object_shadow == all.object_shadow);
        int without = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (all.object[k] > 1 || alone.object[k] > 1) CHECK(alone.object[k] == all.object[k]);
            without += alone.object[k] == 0 && all.object[k] == 1;
        }
        CHECK(without > 0);  // else nothing was left out
    }
}

TEST_CASE("cone labels: the echoes of all kinds have the energies of the image") {
    // Two planes that mirror sound to each other, as the sides of a roof seen from below. An image
    // is its labels' echoes times one factor, direct or by multipath.
    for (const SonarKind kind :
         {SonarKind::imaging, SonarKind::sidescan, SonarKind::echosounder, SonarKind::scanning}) {
        CAPTURE(static_cast<int>(kind));
        SonarConfig config = bare_sonar(default_sonar(kind), 3e5);
        set_range(config, config.range_min_m, 12.0, 300);
        config.multipath.method = MultipathMethod::exact;
        const bool looks_down = kind == SonarKind::sidescan || kind == SonarKind::echosounder;
        if (kind == SonarKind::imaging) config.elevation_deg = 60.0;
        if (kind == SonarKind::sidescan) config.elevation_deg = 4.0;
        if (kind == SonarKind::echosounder) config.opening_deg = 50.0;
        if (kind == SonarKind::scanning) {
            config.azimuth_deg = 8.0;
            config.sector_deg = config.step_deg = 1.0;
        }
        const Sonar sonar = make_sonar(config, {0.02});
        Scene scene = empty_scene();
        const std::uint32_t m = add_material(scene, 0.4F);
        for (const float side : {-1.0F, 1.0F}) {
            // Along the view's axis, across, and along the ridge.
            const auto at = [&](float out, float along) -> Eigen::Vector3f {
                const Eigen::Vector3f p(8.0F - 0.84F * out, side * out, along);
                return looks_down ? Eigen::Vector3f(p.z(), p.y(), -p.x())
                                  : Eigen::Vector3f(p.x(), p.z(), p.y());
            };
            add_quad(scene, at(0, -4), at(4, -4), at(4, 4), at(0, 4), m);
        }
        const auto engine = engine_of(scene, EngineKind::rays);
        const TracedPing traced = trace(sonar, scene, *engine, Pose{}, 0);
        double direct = 0.0;
        double multipath = 0.0;
        sonar.settings.model->surface_echoes(
            traced, sonar.settings.view, scene, {}, [&](const EchoBlock& echoes) {
                double& sum = echoes.multipath ? multipath : direct;
                for (int k = 0; k < echoes.count; ++k)
                    sum += static_cast<double>(echoes.weight[k]) * echoes.intensity[k];
            });
        REQUIRE(direct > 0.0);
        REQUIRE(multipath > 0.0);
        const auto image = [&](const Terms& terms) {
            return total(form_image(traced, sonar.settings, scene, {}, terms).intensity);
        };
        const double factor = image(direct_echoes_alone) / direct;
        CHECK(image(multipath_alone) / multipath == approx(factor).epsilon(0.02));
    }
}

TEST_CASE("cone labels: the shadow of a large face has no holes and ends where it should") {
    // A plate at x = 4 m, 1 m high, stands 2 m below the sonar and hides the floor up to x = 8 m. A
    // beam of the sine s sees the place x at r^2 (1 - s^2) = x^2 + 4.
    Scene scene = floor_scene(30.0F, -2.0F, 0.4F);
    add_rectangle(scene, {4, -1, -2}, {4, 1, -1}, 0);
    for (const Spacing spacing : spacings) {
        const Sonar sonar = wide_fan(spacing);
        for (const EngineKind type : engine_types) {
            CAPTURE(type);
            const Labelled out = label(scene, sonar, Pose{}, type);
            for (int j = beam_at(sonar, -0.1); j <= beam_at(sonar, 0.1); ++j) {
                const double sine = std::sin(sonar.beam_azimuths_rad[j]);
                const auto bin_of = [&](double x) {
                    return bin_at(sonar, std::sqrt((x * x + 4.0) / (1.0 - sine * sine)));
                };
                // A strip is tested at the middle of its column, and its sides may reach further.
                const int near_end = type == EngineKind::strips ? 2 : 1;
                for (int i = bin_of(4.0) + 2; i < out.labels.range_bins; ++i) {
                    if (std::abs(i - bin_of(8.0)) <= near_end) continue;
                    CAPTURE_ALL(i, j);
                    CHECK(out.labels.shadow[out.at(i, j)] == (i < bin_of(8.0) ? 2 : 0));
                }
            }
        }
    }
}

TEST_CASE("sorted table: a place is that of a binary search") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> step(0.1F, 2.0F);
    std::vector<float> numbers{-40.0F};
    while (numbers.size() < 100)
        numbers.push_back(numbers.back() + step(random));
    const SortedTable table(numbers);
    std::vector<float> asked = numbers;
    std::uniform_real_distribution<float> anywhere(-50.0F, 200.0F);
    for (int k = 0; k < 1000; ++k)
        asked.push_back(anywhere(random));
    for (const float x : asked) {
        CAPTURE(x);
        CHECK(table(x) == std::ranges::lower_bound(numbers, x) - numbers.begin());
    }
}
