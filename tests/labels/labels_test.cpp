#include "labels/labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/units.h"
#include "support/bounces.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "visibility/make_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr std::array engine_types{EngineType::rays, EngineType::octree, EngineType::slices};
constexpr LabelRequest everything{true, true, true, true, true};

/// A scene, its labels and the image without noise.
struct Labelled {
    SceneObjects objects;
    PingLabels labels;
    Ping clean;

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * labels.range_bins + i;
    }
};

Labelled label(const Scene& scene, const Sonar& sonar, const Pose& pose, EngineType type) {
    const auto engine = make_engine(scene, {.type = type, .octree = {}});
    const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
    Labelled out;
    out.objects = group_objects(scene, {});
    out.labels = label_ping(traced, sonar.settings, scene, out.objects, *engine, everything);
    out.clean = form_image(traced, sonar.settings, scene, {}, term_by_term[1]);
    return out;
}

int bin_at(const Sonar& sonar, double range_m) {
    return static_cast<int>((range_m - sonar.settings.view.range_min_m) /
                            sonar.settings.view.bin_m());
}

/// The echo of each object in each bin, [beams, range bins, objects], by rays alone: a ray at angle
/// `theta` stands for the solid angle cos(theta), for r^2 times that over the cosine of incidence
/// of surface, and for an echo of reflection times r^2 times that, since Eq. 6 has the cosine once
/// more. No footprints: each ray falls into one bin.
std::vector<double> echoes_by_rays(const Scene& scene, const SceneObjects& objects,
                                   const Sonar& sonar, const Pose& pose) {
    constexpr int across = 12;
    constexpr int up = 2000;
    const View& view = sonar.settings.view;
    const auto engine = make_engine(scene, {});
    std::vector<double> echoes(static_cast<std::size_t>(view.beams) * view.range_bins *
                               objects.objects.size());
    std::vector<Ray> rays(up);
    std::vector<Intersection> met(up);
    for (int n = 0; n < view.beams * across; ++n) {
        const double phi = ((n + 0.5) / (view.beams * across) - 0.5) * view.azimuth_rad;
        const auto theta_of = [&](int k) { return ((k + 0.5) / up - 0.5) * view.elevation_rad; };
        for (int k = 0; k < up; ++k) {
            const double theta = theta_of(k);
            rays[k] = {Eigen::Vector3f::Zero(),
                       Eigen::Vector3d(std::cos(theta) * std::cos(phi),
                                       std::cos(theta) * std::sin(phi), std::sin(theta))
                           .cast<float>()};
        }
        engine->intersect(pose, rays, met);
        for (int k = 0; k < up; ++k) {
            const double r = met[k].distance_m;
            if (r < view.range_min_m || r >= view.range_max_m) continue;
            const auto bin = static_cast<std::size_t>(n / across) * view.range_bins +
                             static_cast<std::size_t>(bin_at(sonar, r));
            echoes[bin * objects.objects.size() + objects.object_of(met[k].instance)] +=
                scene.materials[met[k].material].reflection * r * r * std::cos(theta_of(k));
        }
    }
    return echoes;
}

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("labels: a panel before a wall, its shadow, and water that is open") {
    // The panel covers the azimuths up to atan(0.5 / 3) at 3 m; the wall stands at 6 m, |y| < 2.
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.5F);
    add_quad(scene, {6, -2, -5}, {6, 2, -5}, {6, 2, 5}, {6, -2, 5}, m);
    add_quad(scene, {3, -0.5F, -5}, {3, 0.5F, -5}, {3, 0.5F, 5}, {3, -0.5F, 5}, m);
    const Sonar sonar = noise_free(small_imaging());
    const double panel = std::atan2(0.5, 3.0);
    const double wall = std::atan2(2.0, 6.0);
    for (const EngineType type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, Pose{}, type);
        // Solid angles of the same elevations are as their azimuths.
        REQUIRE(out.labels.visible_share.size() == 2);
        CHECK(out.labels.visible_share[0] == doctest::Approx(1.0 - panel / wall).epsilon(0.02));
        CHECK(out.labels.visible_share[1] == 1.0F);
        for (int j = 0; j < out.labels.beams; ++j) {
            const double a = sonar.azimuth_edges_rad[j];
            const double b = sonar.azimuth_edges_rad[j + 1];
            const double low = std::min(std::fabs(a), std::fabs(b));
            const double high = std::max(std::fabs(a), std::fabs(b));
            const bool straight = high < panel - 0.02;
            const bool beside = low > panel + 0.02 && high < wall - 0.02;
            if (!straight && !beside && low < wall + 0.02) continue;
            // The nearest bins of either that are lit whole.
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

TEST_CASE("labels: two things in one bin share its echo by area and reflection") {
    // Two panels face on at 5 m, one above the boresight, one below: equal areas and angles, so
    // that their shares are those of their reflections, 0.6 and 0.2.
    Scene scene = empty_scene();
    const std::uint32_t strong = add_material(scene, 0.6F);
    const std::uint32_t weak = add_material(scene, 0.2F);
    add_quad(scene, {5, -9, -9}, {5, 9, -9}, {5, 9, 0}, {5, -9, 0}, weak);
    add_quad(scene, {5, -9, 0}, {5, 9, 0}, {5, 9, 9}, {5, -9, 9}, strong);
    const Sonar sonar = noise_free(small_imaging());
    for (const EngineType type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, Pose{}, type);
        double lit = 0.0;
        double agree = 0.0;
        double share = 0.0;
        for (std::size_t k = 0; k < out.labels.size(); ++k) {
            if (out.labels.object[k] == 0) continue;
            ++lit;
            agree += out.labels.object[k] == 2 && out.labels.second[k] == 1;
            share += out.labels.share[k];
            const float sum = out.labels.share[k] + out.labels.second_share[k];
            CHECK(sum == doctest::Approx(1.0).epsilon(1e-5));
        }
        REQUIRE(lit > 100.0);
        CHECK(agree / lit > 0.98);
        CHECK(share / lit == doctest::Approx(0.75).epsilon(0.02));
    }
}

TEST_CASE("labels: the elevation of a floor is that of its range") {
    // At height H over a plane, level, straight ahead: sin(theta) = -H / r. Over a bin of width b
    // theta spreads evenly over b d(theta)/dr, a standard deviation of that over sqrt(12).
    Scene scene = empty_scene();
    add_floor(scene, 100.0F, 0.0F, add_material(scene, 0.6F));
    SonarConfig config = small_imaging();
    config.elevation_deg = 40.0;
    const Sonar sonar = noise_free(config, 0.01);
    constexpr double H = 2.0;
    for (const EngineType type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const Labelled out = label(scene, sonar, {Eigen::Quaterniond::Identity(), {0, 0, H}}, type);
        int bins = 0;
        for (int i = bin_at(sonar, 6.5); i < bin_at(sonar, 9.5); ++i) {
            const double r = 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
            for (int j = 0; j < out.labels.beams; ++j) {
                const float theta = out.labels.elevation_rad[out.at(i, j)];
                const double truth = -std::asin(H / r);
                const double slope = H / (r * std::sqrt(r * r - H * H));
                const double spread = slope * sonar.settings.view.bin_m() / std::sqrt(12.0);
                ++bins;
                CHECK(std::fabs(theta - truth) < 0.5 * slope * sonar.settings.view.bin_m());
                const double told = out.labels.elevation_spread_rad[out.at(i, j)];
                CHECK(told > 0.0);
                CHECK(told / spread < 2.0);
            }
        }
        CHECK(bins > 1000);
        CHECK(std::isnan(out.labels.elevation_rad[out.at(0, 0)]));
    }
}

TEST_CASE("labels: heights above the bottom, of a box, of a ramp and of the bottom itself") {
    // A sonar 2 m above a floor, 20 degrees down, sees 0 to 40 degrees of depression: the floor
    // from 3.1 m on. Straight ahead stands a box half a metre high, from x = 4 to 5 m. The floor
    // before it ends at a range of hypot(4, 2) = 4.47 m and is seen again from x = 5 * 2
    // / 1.5, 6.96 m, on; its top lies at hypot(4, 1.5) = 4.27 to hypot(5, 1.5) = 5.22 m. A ramp
    // from (8, 0) to (9, 0.5) lies at 8.25 to 9.12 m and hides the floor up to x = 9 * 2
    // / 1.5, 12.17 m.
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.5F);
    add_floor(scene, 100.0F, 0.0F, m);
    add_quad(scene, {4, -3, 0.5F}, {5, -3, 0.5F}, {5, 3, 0.5F}, {4, 3, 0.5F}, m);
    add_quad(scene, {4, -3, 0}, {4, 3, 0}, {4, 3, 0.5F}, {4, -3, 0.5F}, m);
    add_quad(scene, {8, -6, 0}, {9, -6, 0.5F}, {9, 6, 0.5F}, {8, 6, 0}, m);
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
    config.range_max_m = 18.0;
    config.range_bins = 512;
    const Sonar sonar = noise_free(config, 0.01);
    const Pose pose{rotation_from_rpy(0.0, radians(20.0), 0.0), {0, 0, 2}};
    for (const EngineType type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const auto engine = make_engine(scene, {.type = type, .octree = {}});
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        const SceneObjects objects = group_objects(scene, {});
        const auto heights = [&](const Bottom* above) {
            return label_ping(traced, sonar.settings, scene, objects, *engine,
                              {.height = true, .bottom = above})
                .height_m;
        };
        const std::vector<float> height = heights(&bottom);
        int bins = 0;
        for (int j = 0; j < sonar.settings.view.beams; ++j) {
            // Beams near the middle, in which azimuth changes no range by more than half a bin.
            if (std::fabs(sonar.azimuth_edges_rad[j]) > 0.04) continue;
            const auto between = [&](double from, double to, const auto& check) {
                for (int i = bin_at(sonar, from); i < bin_at(sonar, to); ++i, ++bins) {
                    CAPTURE(sonar.range_edges_m[i]);
                    check(height[static_cast<std::size_t>(j) * config.range_bins + i],
                          0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]));
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
        CHECK(std::ranges::all_of(heights(nullptr), [](float h) { return std::isnan(h); }));
    }
}

TEST_CASE("labels: a wall on the border of the bottom has heights") {
    // A sonar 2 m above a floor that ends at a wall 6 m ahead, looking level: of the wall it sees
    // the heights from 2 - 6 tan(10) = 0.94 m to 3.06 m, straight ahead first the middle of them.
    Scene scene = empty_scene();
    add_quad(scene, {6, -9, 0}, {6, 9, 0}, {6, 9, 5}, {6, -9, 5}, add_material(scene, 0.5F));
    const Bottom bottom({{{-1, -9, 0}, {6, -9, 0}, {6, 9, 0}, {-1, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    SonarConfig config = small_imaging();
    config.elevation_deg = 20.0;
    const Sonar sonar = noise_free(config, 0.01);
    const Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 2}};
    for (const EngineType type : engine_types) {
        CAPTURE(static_cast<int>(type));
        const auto engine = make_engine(scene, {.type = type, .octree = {}});
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        const PingLabels labels =
            label_ping(traced, sonar.settings, scene, group_objects(scene, {}), *engine,
                       {.elevation = true, .height = true, .bottom = &bottom});
        int lit = 0;
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const bool seen = !std::isnan(labels.elevation_rad[k]);
            REQUIRE(std::isnan(labels.height_m[k]) == !seen);
            if (!seen) continue;
            ++lit;
            // What lies as far above the sonar as below it falls into one bin.
            CHECK(std::fabs(labels.height_m[k] - 2.0F) < 0.2F);
        }
        CHECK(lit > 50);
    }
}

TEST_CASE("labels: lit bins are those of the clean image, multipath bins those of its ghosts") {
    const Scene scene = tank();
    SonarConfig config = small_imaging();
    config.multipath.method = MultipathMethod::cluster;
    const Sonar sonar = noise_free(config);
    const auto engine = make_engine(scene, {});
    const SceneObjects objects = group_objects(scene, {});
    std::uint64_t ghosts = 0;
    for (const Pose& pose : tank_poses()) {
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        const PingLabels labels =
            label_ping(traced, sonar.settings, scene, objects, *engine, everything);
        const Ping clean = form_image(traced, sonar.settings, scene, {}, term_by_term[1]);
        const Ping direct = form_image(traced, sonar.settings, scene, {}, direct_echoes_alone);
        for (int j = 0; j < clean.beams; ++j) {
            for (int i = 0; i < clean.range_bins; ++i) {
                const std::size_t k = static_cast<std::size_t>(j) * clean.range_bins + i;
                REQUIRE((labels.object[k] > 0) == (clean.at(i, j) > 0.0F));
                if (labels.object[k] == 0) continue;
                REQUIRE(labels.share[k] >= labels.second_share[k]);
                if (direct.at(i, j) == 0.0F) {
                    REQUIRE(labels.multipath[k] == 1.0F);
                    ++ghosts;
                }
                if (labels.shadow[k] > 0) REQUIRE(direct.at(i, j) == 0.0F);
            }
        }
    }
    CHECK(ghosts > 0);
}

TEST_CASE("labels: in the tank the objects are those that rays without number find") {
    const Scene scene = tank();
    SonarConfig config = small_imaging();
    config.range_bins = 512;
    config.azimuth_bins = 128;
    config.elevation_deg = 40.0;
    const Sonar sonar = noise_free(config, 0.01);
    const SceneObjects objects = group_objects(scene, {});
    const std::size_t count = objects.objects.size();
    for (const Pose& pose : tank_poses()) {
        const std::vector<double> echoes = echoes_by_rays(scene, objects, sonar, pose);
        for (const EngineType type : engine_types) {
            CAPTURE(static_cast<int>(type));
            const Labelled out = label(scene, sonar, pose, type);
            double lit = 0.0;
            double same = 0.0;
            double unexplained = 0.0;
            for (std::size_t bin = 0; bin < out.labels.size(); ++bin) {
                const double* const echo = &echoes[bin * count];
                const double* const most = std::max_element(echo, echo + count);
                const double total = std::accumulate(echo, echo + count, 0.0);
                if (total == 0.0 || out.labels.object[bin] == 0) continue;
                ++lit;
                const auto told = static_cast<std::size_t>(out.labels.object[bin]) - 1;
                same += most == echo + told;
                // Another object is told only where both are there, or at the edge of a bin, where
                // a footprint reaches over: then a neighbour has it.
                bool near = echo[told] > 0.0;
                for (const int step :
                     {-1, 1, -sonar.settings.view.range_bins, sonar.settings.view.range_bins}) {
                    const std::ptrdiff_t next = static_cast<std::ptrdiff_t>(bin) + step;
                    if (next < 0 || next >= static_cast<std::ptrdiff_t>(out.labels.size()))
                        continue;
                    near = near || echoes[static_cast<std::size_t>(next) * count + told] > 0.0;
                }
                unexplained += !near;
            }
            REQUIRE(lit > 500.0);
            CHECK(same / lit > 0.99);
            CHECK(unexplained / lit < 0.001);
        }
    }
}

TEST_CASE("labels: azimuth runs from starboard to port, as in the image") {
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 1.0F);
    add_sphere(scene, {5, 1.5F, 0}, 0.2F, m, 32);
    add_sphere(scene, {5, -1.5F, 0}, 0.2F, m, 32);
    const Sonar sonar = noise_free(small_imaging());
    const Labelled out = label(scene, sonar, Pose{}, EngineType::rays);
    int seen = 0;
    for (int j = 0; j < out.labels.beams; ++j) {
        for (int i = 0; i < out.labels.range_bins; ++i) {
            const std::uint16_t id = out.labels.object[out.at(i, j)];
            if (id == 0) continue;
            ++seen;
            CHECK(id == (j >= out.labels.beams / 2 ? 1 : 2));
        }
    }
    CHECK(seen > 20);
}

TEST_SUITE_END();
