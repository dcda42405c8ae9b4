#include "simulate/labels/shadow.h"

#include <set>

#include "support/calibrated.h"
#include "support/draws.h"
#include "support/labelled.h"

namespace {

/// A floor of ripples whose heights are drawn, with rocks.
Scene rippled_floor(Uniform& draw) {
    Scene scene = empty_scene();
    const std::uint32_t sand = add_material(scene, 0.2F);
    const std::uint32_t rock = add_material(scene, 0.7F);
    constexpr int cells = 60;
    constexpr float cell_m = 0.2F;
    std::vector<float> heights((cells + 1) * (cells + 1));
    for (float& height : heights)
        height = draw.single(-0.06, 0.06);
    const auto at = [&](int i, int k) {
        return Eigen::Vector3f(static_cast<float>(i) * cell_m - 2.0F,
                               static_cast<float>(k - cells / 2) * cell_m,
                               heights[i * (cells + 1) + k]);
    };
    for (int i = 0; i < cells; ++i) {
        for (int k = 0; k < cells; ++k)
            add_quad(scene, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1), sand);
    }
    for (int n = 0; n < 12; ++n) {
        add_sphere(scene, {draw.single(1.0, 9.0), draw.single(-4.0, 4.0), 0.0F},
                   draw.single(0.1, 0.5), rock, 24);
    }
    return scene;
}

/// A side-scan sonar whose x axis points down, y to port.
Sonar sonar_above_floor(double relative_l1) {
    SonarConfig config = bare_sonar(default_sonar(SonarKind::sidescan), 4e5);
    set_range(config, config.range_min_m, 12.0, 240);
    config.elevation_deg = 8.0;
    config.instrument.beam.width_deg = 1.5;
    Sonar sonar = make_sonar(config, {relative_l1});
    sonar.T_vehicle_sensor = Pose{};
    return sonar;
}

/// A floor 3 m below this sonar.
Scene floor_below() {
    return rectangle_scene({3, -30, -30}, {3, 30, 30}, 0.4F);
}

/// A plate on this floor, 6 m to port and 1 m high, `half` to either side of z.
void add_plate(Scene& scene, float z, float half) {
    add_rectangle(scene, {2, 6, z - half}, {3, 6, z + half}, 0);
}

}  // namespace

TEST_CASE("labels: the shadows of a sea floor are those that rays through all surfaces find" *
          doctest::skip(sanitized)) {
    SonarConfig imaging = small_imaging();
    imaging.range_bins = 512;
    imaging.azimuth_bins = 128;
    SonarConfig sidescan = default_sonar(SonarKind::sidescan);
    sidescan.azimuth_deg = 160.0;
    sidescan.elevation_deg = 0.5;
    set_range(sidescan, 0.5, 8.0, 512);
    struct Case {
        SonarConfig config;
        int scenes;
        RayGrid grid;
    };
    for (const Case& c : {Case{imaging, 2, {6, 1600}}, Case{sidescan, 12, {16000, 8}}}) {
        const Sonar sonar = noise_free(c.config);
        const bool looks_down = c.config.kind == SonarKind::sidescan;
        CAPTURE(looks_down);
        Uniform draw(2);
        double stated = 0.0, truth = 0.0, both = 0.0;
        for (int n = 0; n < c.scenes; ++n) {
            const Scene scene = rippled_floor(draw);
            const Pose pose =
                looks_down ? Pose{Eigen::Quaterniond::Identity(), {draw.between(2, 8), 0.0, 1.2}}
                           : Pose{rotation_from_rpy(draw.between(-0.1, 0.1), draw.between(0.1, 0.4),
                                                    draw.between(-0.4, 0.4)),
                                  {-1.0, draw.between(-2, 2), draw.between(0.8, 1.8)}};
            const Labelled out = label(scene, sonar, pose, EngineKind::strips);
            std::vector<bool> hidden(out.labels.size());  // holds surface behind other surface
            follow_rays(scene, sonar, pose, c.grid, 16,
                        [&](std::size_t bin, double, int layer, double, const Intersection&) {
                            if (layer > 0) hidden[bin] = true;
                        });
            for (std::size_t k = 0; k < hidden.size(); ++k) {
                const bool is = out.labels.shadow[k] > 0;
                const bool should = hidden[k] && out.labels.object[k] == 0;
                stated += is ? 1.0 : 0.0;
                truth += should ? 1.0 : 0.0;
                both += is && should ? 1.0 : 0.0;
            }
        }
        CHECK(truth > 1000.0);
        CHECK(both / stated > 0.98);
        CHECK(both / truth > 0.98);
    }
}

// A box from x = 4 to 6 m hides its own far side. The floor below it is out of view to 8.8 m.
TEST_CASE("labels: a body in open water hides its own far side, whatever lies behind") {
    SonarConfig config = small_imaging();
    config.elevation_deg = 40.0;
    set_range(config, 0.1, 12.0, 119);
    const Sonar sonar = noise_free(config);
    for (const float z : {-3.0F, -40.0F}) {
        Scene scene = floor_scene(60.0F, z, 0.5F);
        add_floor(scene, 60.0F, z - 1.0F, 0);
        add_box(scene, {4.0F, -1.2F, -0.8F}, {6.0F, 1.2F, 0.8F}, 0);
        for (const EngineKind type : {EngineKind::strips, EngineKind::rays}) {
            const Labelled out = label(scene, sonar, Pose{}, type);
            std::set<int> by;
            for (int i = bin_at(sonar, 4.4); i < bin_at(sonar, 5.9); ++i)
                by.insert(out.labels.shadow[out.at(i, sonar.settings.view.beams / 2)]);
            CAPTURE_ALL(z, type, by.size());
            REQUIRE(by.size() == 1);
            CHECK(*by.begin() > 2);  // none of the floors
        }
    }
}

TEST_CASE("labels: hidden surface before the first bin and behind the last covers none") {
    const RangeBins bins{.min_m = 1.0F, .bin_m = 0.1F, .count = 10};
    const auto covered = [&](float range_m) {
        return hidden_bins({{0, 0, range_m, 0.01F, 1.0F}}, bins, 1);
    };
    const std::vector<std::uint8_t> none(10, 0);
    CHECK(covered(0.95F) == none);
    CHECK(covered(2.05F) == none);
    CHECK(covered(1.05F).front() == 1);
    CHECK(covered(1.95F).back() == 1);
}

TEST_CASE("side-scan labels: surface in side lobes does not brighten a shadow") {
    // A plate 0.6 m long hides the floor from sqrt(45) to sqrt(90) m, in a main lobe of 0.2 m.
    const Sonar sonar = sonar_above_floor(0.02);
    const Scene bare_floor = floor_below();
    Scene scene = bare_floor;
    add_plate(scene, 0.0F, 0.3F);
    for (const EngineKind type : {EngineKind::strips, EngineKind::rays}) {
        CAPTURE(type);
        const Labelled out = label(scene, sonar, Pose{}, type);
        const Labelled open = label(bare_floor, sonar, Pose{}, type);
        constexpr int port = 1;
        for (int i = 0; i < out.labels.range_bins; ++i) {
            CAPTURE(i);
            const std::size_t at = out.at(i, port);
            const bool dark =
                i > bin_at(sonar, std::sqrt(45.0)) + 1 && i < bin_at(sonar, std::sqrt(90.0)) - 1;
            if (dark) CHECK(out.labels.shadow[at] > 0);
            if (dark) CHECK(out.labels.object[at] == 0);
            CHECK(open.labels.shadow[at] == 0);
        }
    }
}

TEST_CASE("side-scan labels: a bin is in shadow where its echo falls by 10 dB") {
    // As above, with plates of drawn widths and places along the track: of many the borders of the
    // main lobe receive floor beside the shadow. Ratios within 1 dB of the limit are left out.
    const Sonar sonar = sonar_above_floor(0.01);
    const Scene open_floor = floor_below();
    const Labelled open = label(open_floor, sonar, Pose{}, EngineKind::strips);
    Uniform draw(4);
    int dark = 0, bright = 0, wrong = 0;
    for (int trial = 0; trial < 40; ++trial) {
        Scene scene = open_floor;
        const float half = draw.single(0.02, 0.3);
        const float z = draw.single(-0.3, 0.3);
        add_plate(scene, z, half);
        const Labelled found =
            label(scene, sonar, Pose{}, EngineKind::rays, everything, objects_on_floor(scene));
        constexpr int port = 1;
        for (int i = bin_at(sonar, std::sqrt(45.0)) + 2; i < bin_at(sonar, std::sqrt(90.0)) - 1;
             ++i) {
            const float ratio = found.clean.at(i, port) / open.clean.at(i, port);
            if (ratio > 0.08F && ratio < 0.125F) continue;
            ++(ratio < 0.1F ? dark : bright);
            wrong += (found.labels.shadow[open.at(i, port)] > 0) != (ratio < 0.1F);
        }
    }
    CAPTURE_ALL(dark, bright, wrong);
    CHECK(dark > 400);
    CHECK(bright > 400);
    CHECK(wrong <= (dark + bright) / 100);
}

// A tall wall stands on a floor. The bins behind it are in its shadow with or without the floor's
// echo through it, and the label of that echo is the floor.
TEST_CASE("labels: behind a thin wall shadows stay, and the echo in them is the floor's") {
    SonarConfig config = bare_sonar(small_imaging(), 4e5);
    Scene scene = floor_scene(12.0F, -1.0F, 0.4F, 4);
    const std::uint32_t wall = add_material(scene, 0.1F);
    scene.materials[wall].density_kg_m3 = 950.0;
    scene.materials[wall].sound_speed_m_s = 2460.0;
    add_rectangle(scene, {6, -1, -1}, {6, 1, 2}, wall);
    for (const EngineKind engine : engine_types) {
        const auto labelled = [&] {
            Sonar sonar = make_sonar(config, {});
            prepare_for(scene, sonar);
            return label(scene, sonar, pitched(8.0), engine).labels;
        };
        scene.materials[wall].wall_mm.reset();
        const PingLabels opaque = labelled();
        scene.materials[wall].wall_mm = 4.0;
        const PingLabels thin = labelled();
        CHECK(thin.shadow == opaque.shadow);
        CHECK(thin.visible_share == opaque.visible_share);
        std::map<int, int> before, now;  // the objects of the bins in the wall's shadow
        for (std::size_t k = 0; k < thin.size(); ++k) {
            if (thin.shadow[k] != 2) continue;
            ++before[opaque.object[k]];
            ++now[thin.object[k]];
        }
        CHECK(before.size() == 1);
        CHECK(before[0] > 200);
        CHECK(now[1] > 0.9 * before[0]);
        CHECK(now[2] == 0);
    }
}
