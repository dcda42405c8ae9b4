#include "simulate/labels/shadow.h"

#include "simulate/labels/hidden_surface.h"
#include "simulate/sonar/kinds.h"
#include "simulate/visibility/angles.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/labelled.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

SonarConfig imaging_128() {
    SonarConfig config = small_imaging();
    config.range_bins = 512;
    config.azimuth_bins = 128;
    return config;
}

/// Rays that cover a view: `across` columns to a fan's beam, evenly spread over either side.
struct RayGrid {
    int across, up;
};

/// The bins that hold surface behind other surface, [beams, range bins], by rays alone: each goes
/// on through all that it meets, and each hit behind the first falls into one bin.
std::vector<bool> hidden_by_rays(const Scene& scene, const Sonar& sonar, const Pose& pose,
                                 const RayGrid& grid) {
    constexpr float step = 1e-5F;
    const View& view = sonar.settings.view;
    const auto engine = make_engine(scene, {});
    std::vector<bool> hidden(static_cast<std::size_t>(view.beams) * view.range_bins);
    const int columns = view.beams * grid.across;
    for (int n = 0; n < columns; ++n) {
        const double azimuth = ((n + 0.5) / columns - 0.5) * view.azimuth_rad;
        std::vector<Ray> rays;
        for (int k = 0; k < grid.up; ++k) {
            const double elevation = ((k + 0.5) / grid.up - 0.5) * view.elevation_rad;
            rays.push_back(
                {Eigen::Vector3f::Zero(), direction_of(azimuth, elevation).cast<float>()});
        }
        std::vector<Intersection> met;
        for (int layer = 0; !rays.empty() && layer < 16; ++layer) {
            met.resize(rays.size());
            engine->intersect(pose * sonar.T_vehicle_sensor, rays, met);
            std::size_t going_on = 0;
            for (std::size_t k = 0; k < rays.size(); ++k) {
                const float range = rays[k].origin.norm() + met[k].distance_m;
                if (!(range < view.range_max_m)) continue;
                if (layer > 0 && range >= view.range_min_m) {
                    hidden[static_cast<std::size_t>(n / grid.across) * view.range_bins +
                           bin_at(sonar, range)] = true;
                }
                rays[going_on++] = {rays[k].direction * (range * (1.0F + step)), rays[k].direction};
            }
            rays.resize(going_on);
        }
    }
    return hidden;
}

struct Score {
    double shadow = 0.0, true_shadow = 0.0, both = 0.0;

    double precision() const { return both / shadow; }
    double recall() const { return both / true_shadow; }
};

/// Counts the bins in shadow, those that show no surface and hold some that rays find hidden, and
/// those that are both.
void add_score(const Scene& scene, const Sonar& sonar, const Pose& pose, const RayGrid& grid,
               Score& score) {
    const std::vector<bool> hidden = hidden_by_rays(scene, sonar, pose, grid);
    const Labelled out = label(scene, sonar, pose, EngineKind::slices);
    for (std::size_t k = 0; k < hidden.size(); ++k) {
        const bool is = out.labels.shadow[k] > 0;
        const bool should = hidden[k] && out.labels.object[k] == 0;
        score.shadow += is ? 1.0 : 0.0;
        score.true_shadow += should ? 1.0 : 0.0;
        score.both += is && should ? 1.0 : 0.0;
    }
}

void check(const Score& score) {
    CHECK(score.shadow > 1000.0);
    CHECK(score.precision() > 0.98);
    CHECK(score.recall() > 0.98);
}

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

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("labels: the shadows of a sea floor are those that rays through all surfaces find" *
          doctest::skip(sanitized)) {
    Uniform draw(2);
    const Sonar sonar = noise_free(imaging_128());
    Score score;
    for (int n = 0; n < 2; ++n) {
        const Scene scene = rippled_floor(draw);
        const Pose pose{rotation_from_rpy(draw.between(-0.1, 0.1), draw.between(0.1, 0.4),
                                          draw.between(-0.4, 0.4)),
                        {-1.0, draw.between(-2, 2), draw.between(0.8, 1.8)}};
        add_score(scene, sonar, pose, {6, 1600}, score);
    }
    check(score);
}

TEST_CASE("labels: the shadows of a lattice are those that rays through all surfaces find" *
          doctest::skip(sanitized)) {
    Uniform draw(3);
    Scene scene = empty_scene();
    const std::uint32_t steel = add_material(scene, 0.8F);
    add_floor(scene, 15.0F, 0.0F, steel, 4);
    for (int n = 0; n < 30; ++n) {
        const bool upright = n % 2 == 0;
        const Eigen::Vector3f low(draw.single(2, 8), draw.single(-3, 3),
                                  upright ? 0.0F : draw.single(0.1, 1.5));
        const Eigen::Vector3f length(0.08F, upright ? 0.06F : 1.5F, upright ? 2.5F : 0.06F);
        add_box(scene, low, low + length, steel);
    }
    Score score;
    const Pose pose{rotation_from_rpy(0.05, 0.25, 0.0), {-0.5, 0.0, 1.5}};
    add_score(scene, noise_free(imaging_128()), pose, {16, 2400}, score);
    check(score);
}

TEST_CASE("labels: the shadows of a side-scan are those that rays through all surfaces find" *
          doctest::skip(sanitized)) {
    Uniform draw(4);
    SonarConfig config = default_sonar(SonarKind::sidescan);
    config.azimuth_deg = 160.0;
    config.elevation_deg = 0.5;
    config.range_min_m = 0.5;
    config.range_max_m = 8.0;
    config.range_bins = 512;
    const Sonar sonar = noise_free(config);
    Score score;
    for (int n = 0; n < 12; ++n) {
        const Scene scene = rippled_floor(draw);
        const Pose pose{Eigen::Quaterniond::Identity(), {draw.between(2, 8), 0.0, 1.2}};
        add_score(scene, sonar, pose, {16000, 8}, score);
    }
    check(score);
}

TEST_CASE(
    "labels: in a full turn the beams next to the seam lend each other the owner of a shadow") {
    // 12 beams. Lines end in the beams 11 and 2; beam 0 is next to 11, and in a fan nearest to 2.
    View view{.azimuth_rad = 2.0 * pi,
              .elevation_rad = 0.5,
              .range_min_m = 1.0,
              .range_max_m = 2.0,
              .range_bins = 1,
              .beams = 12};
    const std::vector<HiddenPiece> pieces{{11, 4, 1.5F, 0.1F, 1.0F}, {2, 7, 1.5F, 0.1F, 1.0F}};
    const std::vector<std::uint8_t> covered{1};
    const std::vector<std::uint8_t> occupied{0};
    const auto owner_in_beam_0 = [&] {
        std::vector<std::uint16_t> shadow(1);
        ShadowFinder(pieces, view).find(0, covered, occupied, shadow);
        return shadow.front();
    };
    CHECK(owner_in_beam_0() == 4 + 1);
    view.azimuth_rad = 2.0;
    CHECK(owner_in_beam_0() == 7 + 1);
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
    // The sensor's x axis points down, y to port, the floor lies 3 m below. A plate 6 m to port, 1
    // m high and 0.3 m long, hides the floor from sqrt(45) to sqrt(90) m: the main lobe is 0.06 m
    // wide there, the traced view 0.47 m.
    SonarConfig config = calibrated(default_sonar(SonarKind::sidescan), 4e5);
    config.name = "sss";
    config.range_max_m = 12.0;
    config.range_bins = 240;
    config.elevation_deg = 8.0;
    config.instrument = bare(config.instrument);
    config.instrument.beam.width_deg = 1.5;
    Sonar sonar = make_sonar(config, {0.02});
    sonar.T_vehicle_sensor = Pose{};
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.4F);
    add_quad(scene, {3, -30, -30}, {3, 30, -30}, {3, 30, 30}, {3, -30, 30}, m);
    add_quad(scene, {2, 6, -0.3F}, {3, 6, -0.3F}, {3, 6, 0.3F}, {2, 6, 0.3F}, m);
    Scene bare_floor = scene;
    bare_floor.triangles.resize(2);
    bare_floor.triangle_material.resize(2);
    bare_floor.triangle_instance.resize(2);
    for (const EngineKind type : {EngineKind::slices, EngineKind::rays}) {
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

TEST_SUITE_END();
