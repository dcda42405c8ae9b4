#include "simulate/product/soundings.h"

#include "simulate/product/bathymetry.h"
#include "support/draws.h"
#include "support/sonars.h"

namespace {

/// Three beams of 40 degrees, 100 bins of 10 cm from 0.
Sonar three_beams(bool scale_with_range = false) {
    SonarConfig config = default_sonar(SonarKind::profiling);
    set_range(config, 0.0, 10.0, 100);
    config.azimuth_bins = 3;
    config.noise.scale_with_range = scale_with_range;
    return make_sonar(config, {});
}

/// 1500 m/s + `gradient` z.
std::shared_ptr<const SoundProfile> linear_profile(double gradient) {
    return std::make_shared<const SoundProfile>(
        SoundProfile{{-100.0, 0.0}, {1500.0 - 100.0 * gradient, 1500.0}, 1500.0});
}

Sonar multibeam(double range_max_m, int beams, double azimuth_deg = 120.0) {
    SonarConfig config = default_sonar(SonarKind::profiling);
    config.azimuth_deg = azimuth_deg;
    set_range(config, config.range_min_m, range_max_m, static_cast<int>(50.0 * range_max_m));
    config.azimuth_bins = beams;
    return make_sonar(config, {0.02});
}

}  // namespace

TEST_CASE("detect return: a bright stretch of any place and length is found exactly") {
    // A run that is one bin longer or shorter than a stretch of n bins of brightness b over m bins
    // of 0 in all has the contrast b n (1 - n / m) / sqrt(n) times sqrt(n / (n + 1)), or times
    // sqrt((n - 1) / n) and less: the stretch itself is the best.
    for (const int length : {1, 2, 3, 5, 9, 17, 40}) {
        for (int begin = 0; begin + length <= 100; begin += 7) {
            std::vector<double> beam(100, 0.25);
            std::fill_n(beam.begin() + begin, length, 0.75);
            const DetectedReturn run = detect_return(beam);
            CAPTURE_ALL(length, begin);
            CHECK(run.begin == begin);
            CHECK(run.end == begin + length);
            CHECK(run.contrast == approx(0.5 * std::sqrt(length) * (1.0 - length / 100.0)));
            CHECK(run.rival == approx(0.0).epsilon(1e-12));
        }
    }
}

TEST_CASE("detect return: a second surface is its rival") {
    // Contrasts about the mean 0.11: (4 x 2 - 4 x 0.11) / 2 = 3.78, (3 - 0.11) / 1 = 2.89.
    std::vector<double> beam(100, 0.0);
    std::fill_n(beam.begin() + 20, 4, 2.0);
    beam[70] = 3.0;
    const DetectedReturn run = detect_return(beam);
    CHECK(run.begin == 20);
    CHECK(run.end == 24);
    CHECK(run.contrast == approx(3.78));
    CHECK(run.rival == approx(2.89));
}

TEST_CASE("detect return: nothing stands out of a level beam, or of none") {
    CHECK(detect_return({}).end == 0);
    CHECK(detect_return(std::vector<double>(50, 0.0)).end == 0);
    CHECK(detect_return(std::vector<double>(1, 3.0)).end == 0);
}

TEST_CASE("soundings: the middle of the strongest run, in the world") {
    const Sonar sonar = three_beams();
    Ping ping = even_ping(sonar, 0.0F);
    // Beam 2, 40 degrees to port: bins 60, 61, 62 of 0.2, 0.4, 0.3: all three stand out by
    // (0.9 - 0.027) / sqrt(3) = 0.504, the last two by (0.7 - 0.018) / sqrt(2) = 0.482.
    ping.intensity[60 * 3 + 2] = 0.2F;
    ping.intensity[61 * 3 + 2] = 0.4F;
    ping.intensity[62 * 3 + 2] = 0.3F;
    // The bow along world y: port is -x.
    const Pose pose{rotation_from_rpy(0.0, 0.0, 0.5 * pi), {100.0, 200.0, 7.0}};
    const std::vector<Sounding> soundings = find_soundings(sonar, pose, ping);
    CHECK(std::isnan(soundings[0].range_m));
    CHECK(std::isnan(soundings[0].position.z()));
    CHECK(soundings[0].quality == 0.0);
    const double range = 6.15;
    CHECK(soundings[2].range_m == approx(range));
    CHECK(soundings[2].quality == approx(1.0));
    const Eigen::Vector3d expected(100.0 - range * std::sin(radians(40.0)), 200.0,
                                   7.0 - range * std::cos(radians(40.0)));
    CHECK((soundings[2].position - expected).norm() < 1e-9);
}

TEST_CASE("soundings: noise hides no bottom that stands out of it") {
    struct Case {
        const char* what;
        Sonar sonar;
        std::function<double(int bin, double uniform)> noise;
        int bottom_bin;
        float bottom;
    };
    SonarConfig calibrated = three_beams(true).config;
    calibrated.model = ModelKind::calibrated;
    SonarConfig raised = three_beams().config;
    raised.model = ModelKind::calibrated;
    raised.range_max_m = 40.0;
    const Sonar with_tvg = make_sonar(raised, {});
    const std::span<const float> mean = with_tvg.settings.model->info.mean_noise;
    REQUIRE(mean.size() == 100);
    CHECK(mean[99] > 0.005F);
    CHECK(mean[10] < 1e-5F * mean[99]);
    const std::vector<Case> cases{
        // (r / r_max)^2 times Rayleigh of scale 0.02: above the bottom at 10 m, not at 3 m.
        {"grows with range, the bottom is near", three_beams(true),
         [](int bin, double u) {
             return 0.02 * std::pow((bin + 0.5) / 100.0, 2) * std::sqrt(-2.0 * std::log(u));
         },
         30, 0.05F},
        // Divided by (r / r_max)^2 the first bins would stand 4e4 above the last ones.
        {"is as strong at all ranges, the bottom is far", make_sonar(calibrated, {}),
         [](int, double u) { return -0.001 * std::log(u); }, 90, 0.05F},
        {"is raised by the TVG, the bottom is near", with_tvg,
         [&](int bin, double u) { return -mean[bin] * std::log(u); }, 10, 0.01F}};
    for (const Case& one : cases) {
        CAPTURE(one.what);
        Uniform random(3);
        const std::vector<double>& edges = one.sonar.range_edges_m;
        for (int trial = 0; trial < 100; ++trial) {
            Ping ping = even_ping(one.sonar, 0.0F);
            for (int i = 0; i < 100; ++i) {
                for (int j = 0; j < 3; ++j) {
                    const double noise = one.noise(i, random.between(1e-9, 1.0));
                    ping.intensity[i * 3 + j] =
                        static_cast<float>(noise) + (i == one.bottom_bin ? one.bottom : 0.0F);
                }
            }
            for (const Sounding& sounding : find_soundings(one.sonar, Pose{}, ping)) {
                const double middle = 0.5 * (edges[one.bottom_bin] + edges[one.bottom_bin + 1]);
                CHECK(std::fabs(sounding.range_m - middle) < 0.05);
                CHECK(sounding.quality > map_quality);
            }
        }
    }
    raised.instrument.receiver.noise_db = -300.0;  // none
    CHECK(make_sonar(raised, {}).settings.model->info.mean_noise.empty());
}

TEST_CASE("soundings: side lobes and the rise of the background have no quality") {
    SonarConfig config = three_beams().config;
    config.model = ModelKind::calibrated;
    const Sonar sonar = make_sonar(config, {});
    const std::span<const float> noise = sonar.settings.model->info.mean_noise;
    Ping ping = even_ping(sonar, 0.0F);
    for (int i = 0; i < 300; ++i)
        ping.intensity[i] = (i % 3 == 2 && i >= 180 ? 3.0F : 1.0F) * noise[i / 3];
    ping.intensity[50 * 3 + 1] = 1e6F * noise[50];
    ping.intensity[50 * 3] = 1e3F * noise[50];
    const std::vector<Sounding> found = find_soundings(sonar, Pose{}, ping);
    CHECK(found[0].quality == 0.0);
    CHECK(found[1].quality > 0.9);
    CHECK(found[2].quality == 0.0);
}

// Gaussian beams over oblique ground: the echo of bin i has the amplitude of its speckle times
// exp(-((i - c_j) / 8)^2) in beam j, c_j = 40, 50, 60. The axis of beam 1 lies in the middle of bin
// 50. The logarithm of the ratio of beams 0 and 2 is a line without speckle.
TEST_CASE("soundings: on oblique ground they lie where both neighbours are equally strong") {
    SonarConfig config = three_beams().config;
    config.model = ModelKind::calibrated;
    const Sonar sonar = make_sonar(config, {});
    config.model = ModelKind::paper;
    const Sonar without_patterns = make_sonar(config, {});
    Uniform random(5);
    double by_middle = 0.0;
    constexpr int trials = 100;
    for (int trial = 0; trial < trials; ++trial) {
        Ping ping = even_ping(sonar, 0.0F);
        for (int i = 20; i < 80; ++i) {
            const double speckle = std::sqrt(-0.1 * std::log(random.between(1e-9, 1.0)));
            for (int j = 0; j < 3; ++j) {
                const double off = (i - 40 - 10 * j) / 8.0;
                ping.intensity[i * 3 + j] = static_cast<float>(speckle * std::exp(-off * off));
            }
        }
        CHECK(std::fabs(find_soundings(sonar, Pose{}, ping)[1].range_m - 5.05) < 1e-3);
        const double middle = find_soundings(without_patterns, Pose{}, ping)[1].range_m;
        by_middle += (middle - 5.05) * (middle - 5.05) / trials;
    }
    CHECK(std::sqrt(by_middle) > 0.1);  // more than a bin
}

TEST_CASE("bathymetry: no sounding is lost on the border of a cell") {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> tenths(-200, 200);
    for (const double cell_m : {0.1, 0.3, 0.5, 1.0, 2.0}) {
        std::vector<Eigen::Vector3d> points;
        GroundBounds bounds;
        for (int k = 0; k < 50; ++k) {
            points.emplace_back(0.1 * tenths(random), 0.1 * tenths(random), -1.0);
            bounds.add(points.back());
        }
        GroundGrid grid = make_ground_grid(bounds, cell_m);
        for (const Eigen::Vector3d& point : points)
            grid.add(point);
        CHECK(total(grid.weight) == points.size());
        grid.add({100.0, 0.0, -1.0});  // outside: dropped, not clamped
        CHECK(total(grid.weight) == points.size());
    }
}

TEST_CASE("bathymetry: the picture of a long and narrow map shows its cells") {
    GroundBounds bounds;
    bounds.add({0.5, 0.5, 0});
    bounds.add({9999.5, 1.5, 0});
    GroundGrid grid = make_ground_grid(bounds, 1.0);
    for (int x = 0; x < 10000; ++x) {
        for (const double y : {0.5, 1.5})
            grid.add({x + 0.5, y, -10.0 - 0.001 * x});
    }
    Picture picture = draw_bathymetry(grid);
    // Three cells to a pixel, in a row below the margin.
    const std::span<const Rgb> row(picture.row(10) + 10, 3333);
    CHECK(std::ranges::none_of(row, [](const Rgb& p) { return p == backdrop; }));
}

TEST_CASE("bathymetry: cells suit the soundings, and never are too many") {
    GroundBounds bounds;
    bounds.add({0, 0, 0});
    bounds.add({40, 20, 0});
    bounds.count = 32'000;  // 4 * 800 m^2 / 32000 = 0.1 m^2: cells of 0.32 m, rounded up
    CHECK(make_ground_grid(bounds, 0.0).cell_m == 0.5);
    GroundBounds line;
    for (int k = 0; k < 400; ++k)
        line.add({0.2 * k, 0.2 * k, 0});
    GroundGrid coarse = make_ground_grid(line, 0.0);
    CHECK(coarse.cell_m == 10.0);
    for (int k = 0; k < 400; ++k)
        coarse.add({0.2 * k, 0.2 * k, 0});
    CHECK(cell_of_soundings(coarse, 400) == 5.0);  // on its diagonal: 10 sqrt(4 * 8 / 400)
    CHECK(make_ground_grid({}, 0.0).columns == 0);
    const GroundGrid held =
        make_ground_grid(bounds, 5e-324);  // the finest that a mission can ask for
    CHECK(held.cell_m > 1e-3);
    CHECK(static_cast<double>(held.columns) * held.rows <= 1 << 24);
    GroundBounds point;
    point.add({3, 4, 5});
    CHECK(make_ground_grid(point, 0.0).columns == 1);
}

TEST_CASE("bathymetry: cells of any size, anywhere, have a picture") {
    // 1e-3F is below the step of float there: heights from low to low + 1e-3F would be empty.
    for (const double far : {1e5, 1e7, 1e8, -1e8}) {
        GroundBounds bounds;
        bounds.add({far, far, far});
        GroundGrid grid = make_ground_grid(bounds, 1.0);
        grid.add({far, far, far});
        REQUIRE(grid.weight[0] == 1.0);
        CHECK(draw_bathymetry(grid).width > 0);
    }
    // 0.4 * 0.05 is above 0.02 in doubles: halving the bar that way never ended.
    for (double cell_m = 1e-3; cell_m < 1e3; cell_m *= 1.07) {
        GroundBounds bounds;
        bounds.add({0, 0, 0});
        bounds.add({cell_m, 0, 0});
        CHECK(draw_bathymetry(make_ground_grid(bounds, cell_m)).width > 0);
    }
    for (const double cell_m : {0.0685851289138515, 0.05, 0.5})
        CHECK(round_down_125(cell_m) <= cell_m);
}

TEST_CASE("soundings in a gradient lie on the flat bottom, by the profile of the water") {
    for (const double g : {0.5, -0.5}) {
        Scene scene = floor_scene(200.0F, -40.0F, 0.5F);
        scene.sound_profile = linear_profile(g);
        Sonar sonar = multibeam(120.0, 240);
        sonar.sound_profile = scene.sound_profile;
        const auto soundings = find_soundings(sonar, {}, look(sonar, scene));
        double outermost = 0.0;
        for (std::size_t j = 0; j < soundings.size(); ++j) {
            REQUIRE(!std::isnan(soundings[j].range_m));
            const double a = std::fabs(sonar.beam_azimuths_rad[j]) - 0.5 * pi;
            // Bins of 2 cm, and beams of half a degree.
            const double slack = 0.03 + 0.03 * std::fabs(std::cos(a) / std::sin(a));
            CHECK(std::fabs(soundings[j].position.z() + 40.0) < slack);
            outermost = std::max(outermost, std::fabs(soundings[j].position.y()));
        }
        CHECK(outermost > 60.0);
    }
}

TEST_CASE("soundings of a sonar that rolls and drives in a ping lie on the flat bottom") {
    // In the 80 ms until the echo is back the sonar rolls by a degree, which moves a sounding
    // 50 degrees off by 0.8 m in height, and drives by 0.3 m.
    Scene scene = floor_scene(200.0F, -40.0F, 0.5F);
    Sonar sonar = multibeam(90.0, 100, 100.0);
    // In the sensor's frame, whose z axis points ahead.
    const PingMotion motion{{0.0, 0.0, 4.0}, {0.0, 0.0, radians(12.0)}, 1500.0};
    sonar.motions = std::make_shared<const std::vector<PingMotion>>(1, motion);
    for (const bool bends : {false, true}) {
        if (bends) {
            scene.sound_profile = linear_profile(-0.5);
            sonar.sound_profile = scene.sound_profile;
        }
        int found = 0;
        for (const Sounding& sounding : find_soundings(sonar, {}, look(sonar, scene), motion)) {
            // Surface that enters the sector in the ping is missing.
            if (std::isnan(sounding.range_m)) continue;
            ++found;
            CHECK(std::fabs(sounding.position.z() + 40.0) < 0.15);
            CHECK(std::fabs(sounding.position.x()) < 0.01);
        }
        CHECK(found >= 98);
    }
}
