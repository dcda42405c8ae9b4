#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "calibrated/decibel.h"
#include "calibrated/sediment_paths.h"
#include "core/units.h"
#include "support/calibrated.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double sonar_height_m = 6.0;
constexpr double reflected_by_mesh = 0.8;
constexpr double mesh_slope_deg = 3.0;

/// An echosounder of 12 kHz, 6 m above sand, and what lies below it.
struct BuriedScene {
    Scene scene = empty_scene();
    std::uint32_t floor, metal;
    Sonar sonar;

    BuriedScene() : floor(add_material(scene, 0.3F)), metal(add_material(scene, 0.8F)) {
        scene.materials[floor].grain_phi = 2.0;
        scene.materials[metal].slope_rms_deg = mesh_slope_deg;
        scene.materials[metal].lambert_db = -80.0;
        add_floor(scene, 30.0F, 0.0F, floor, 4);
        scene.instances.emplace_back("mesh");
        SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), 12e3);
        config.opening_deg = 120.0;
        config.range_min_m = 1.0;
        config.range_max_m = 16.0;
        config.range_bins = 300;
        config.instrument = bare(config.instrument);
        config.instrument.beam.width_deg = 60.0;
        config.instrument.pulse.resolution_m = 0.1;
        sonar = make_sonar(config, {});
    }

    std::vector<SedimentPath> sediments() const {
        return sediment_paths(scene.materials, {}, 12e3,
                              calibrated_model_of(sonar).absorption_db_per_m);
    }

    /// The energy of the whole image.
    double energy(const Sonar& seen_by) const {
        const auto engine = make_engine(scene, {});
        const Pose at{Eigen::Quaterniond::Identity(), {0.0, 0.0, sonar_height_m}};
        const TracedPing traced = trace(seen_by, scene, *engine, at, 0);
        const std::vector<float> image =
            form_image(traced, seen_by.settings, scene, {}, without_random_terms).intensity;
        return std::accumulate(image.begin(), image.end(), 0.0);
    }

    /// The level of the mesh over that of a point of 1 m^2 at a place.
    double level_over_point_db(const Eigen::Vector3d& place) const {
        Sonar alone = sonar;
        find_targets({&alone, 1}, scene);
        Sonar with_mesh = alone;
        with_mesh.settings.buried = std::make_shared<const BuriedObjects>(
            BuriedObjects{{static_cast<std::uint32_t>(scene.instances.size() - 1)}, sediments()});
        Sonar with_point = alone;
        Particles particles;
        particles.sediments = sediments();
        Particle& point = particles.all.emplace_back();
        point.start_m = place;
        point.velocity_m_s = Eigen::Vector3d::Zero();
        point.section_m2 = 1.0F;
        point.buried = true;
        with_point.settings.particles = std::make_shared<const Particles>(particles);
        const double bottom = energy(alone);
        const double mesh = energy(with_mesh) - bottom;
        REQUIRE(mesh > 0.0);
        return db_of_power(mesh / (energy(with_point) - bottom));
    }
};

/// The direction in which refracted sound arrives at a place below the bottom, from above x = 0.
Eigen::Vector3d arrival_at(const SedimentPath& sand, const Eigen::Vector3d& place) {
    const WayIntoBottom way = way_into_bottom(sand, sonar_height_m, -place.z(), place.x());
    const double sine = sand.speed_ratio * std::sin(way.angle_rad);
    return {sine, 0.0, -std::sqrt(1.0 - sine * sine)};
}

}  // namespace

TEST_SUITE("calibrated") {
    // A sphere of radius a, many slopes s of facets large, has 10 log(R a^2 / 4 (1 + s^2)), at the
    // place whose normal is against the arriving sound. Seen from r, its highlight is narrower by
    // 1 / (1 + a / r) both ways.
    TEST_CASE("buried mesh: a sphere is a point at its highlight, at any angle") {
        for (const double across : {0.0, 3.0, 6.0}) {
            BuriedScene below;
            const double a = 0.15;
            const Eigen::Vector3d centre(across, 0.0, -0.45);
            add_sphere(below.scene, centre.cast<float>(), static_cast<float>(a), below.metal, 48);
            const SedimentPath sand = below.sediments()[below.floor];
            Eigen::Vector3d highlight = centre;
            for (int k = 0; k < 3; ++k)
                highlight = centre - a * arrival_at(sand, highlight);
            const double range =
                way_into_bottom(sand, sonar_height_m, -highlight.z(), highlight.x()).range_m(sand);
            const double slope = radians(mesh_slope_deg);
            const double section = reflected_by_mesh * a * a / 4.0 * (1.0 + slope * slope) /
                                   std::pow(1.0 + a / range, 2);
            CAPTURE(across);
            CHECK(std::fabs(below.level_over_point_db(highlight) - db_of_power(section)) < 0.2);
        }
    }

    // A plate of 10 cm that faces the arriving sound has R / (8 pi s^2) of its area. One that faces
    // the straight line to the sonar is off by the refraction t, and has exp(-tan^2 t / (2 s^2)) /
    // cos^4 t of that.
    TEST_CASE("buried mesh: a plate faces the sound as it is refracted") {
        const Eigen::Vector3d place(5.0, 0.0, -0.3);
        for (const bool straight : {false, true}) {
            BuriedScene below;
            const SedimentPath sand = below.sediments()[below.floor];
            const Eigen::Vector3d arrives = arrival_at(sand, place);
            const Eigen::Vector3d line =
                (place - sonar_height_m * Eigen::Vector3d::UnitZ()).normalized();
            const Eigen::Vector3f normal = -(straight ? line : arrives).cast<float>();
            const Eigen::Vector3f u = 0.05F * Eigen::Vector3f::UnitY();
            const Eigen::Vector3f v = normal.cross(u);
            const Eigen::Vector3f p = place.cast<float>();
            add_quad(below.scene, p - u - v, p + u - v, p + u + v, p - u + v, below.metal);
            const double s = std::tan(radians(mesh_slope_deg));
            const double cosine = straight ? line.dot(arrives) : 1.0;
            const double tan2 = 1.0 / (cosine * cosine) - 1.0;
            const double section = 0.01 * reflected_by_mesh / (8.0 * pi * s * s) *
                                   std::exp(-tan2 / (2.0 * s * s)) / std::pow(cosine, 4);
            CAPTURE(straight);
            if (straight) CHECK(tan2 > s * s);
            CHECK(std::fabs(below.level_over_point_db(place) - db_of_power(section)) < 0.3);
        }
    }

    // Sound is as fast in mud as in water, within 2 %: a plate appears within 4 mm of its plane, in
    // which the coherent echo of a smooth face takes all of the power.
    TEST_CASE("buried mesh: a smooth plate has the incoherent echo of a rough one") {
        double rough = 0.0;
        for (const bool smooth : {false, true}) {
            BuriedScene below;
            below.scene.materials[below.floor].grain_phi = 9.0;
            if (smooth) below.scene.materials[below.metal].roughness_m = 2e-6;
            add_quad(below.scene, {-0.05F, -0.05F, -0.2F}, {0.05F, -0.05F, -0.2F},
                     {0.05F, 0.05F, -0.2F}, {-0.05F, 0.05F, -0.2F}, below.metal);
            const double level = below.level_over_point_db({0.0, 0.0, -0.2});
            if (smooth)
                CHECK(std::fabs(level - rough) < 0.01);
            else
                rough = level;
        }
    }

    TEST_CASE("buried mesh: rock hides it, and so does a bottom unless it is said to be buried") {
        BuriedScene below;
        add_sphere(below.scene, {0.0F, 0.0F, -0.45F}, 0.15F, below.metal, 48);
        find_targets({&below.sonar, 1}, below.scene);
        const double hidden = below.energy(below.sonar);
        const std::vector<SedimentPath> none(below.scene.materials.size());
        const auto instance = static_cast<std::uint32_t>(below.scene.instances.size() - 1);
        Sonar over_rock = below.sonar;
        over_rock.settings.buried =
            std::make_shared<const BuriedObjects>(BuriedObjects{{instance}, none});
        CHECK(below.energy(over_rock) == hidden);
    }
}
