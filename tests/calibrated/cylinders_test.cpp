#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "calibrated/decibel.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr SonarKind cylinder_kinds[] = {SonarKind::imaging, SonarKind::sidescan,
                                        SonarKind::echosounder, SonarKind::scanning,
                                        SonarKind::profiling};
constexpr EngineKind cylinder_engines[] = {EngineKind::rays, EngineKind::slices, EngineKind::octree,
                                           EngineKind::automatic};
constexpr float cylinder_reflection = 0.5F;

struct Cylinder {
    Eigen::Vector3d middle, axis;
    double radius, length;
    int sides;
    double roll;

    Eigen::Vector3d at(double along, double angle) const {
        const Eigen::Vector3d u = axis.unitOrthogonal();
        return middle + along * length * axis +
               radius * (std::cos(angle) * u + std::sin(angle) * axis.cross(u));
    }

    Scene scene() const {
        Scene out = empty_scene();
        out.materials[add_material(out, cylinder_reflection)].roughness_m = 0.0;
        std::vector<Eigen::Vector3f> rings[2];
        for (int k = 0; k <= sides; ++k) {
            const double angle = roll + 2.0 * pi * (k % sides) / sides;
            rings[0].push_back(at(-0.5, angle).cast<float>());
            rings[1].push_back(at(0.5, angle).cast<float>());
        }
        for (int k = 0; k < sides; ++k)
            add_quad(out, rings[0][k], rings[0][k + 1], rings[1][k + 1], rings[1][k], 0);
        std::ranges::fill(out.triangle_instance, 0U);  // one object
        out.instances.resize(1);
        return out;
    }

    /// The Kirchhoff integral i V / lambda of cos / r^2 exp(2 i k r) dA over what faces the sonar,
    /// by points an eighth of a wavelength apart.
    double kirchhoff(double wavelength) const {
        const double step = wavelength / 8.0;
        const int along = static_cast<int>(std::ceil(length / step));
        const int around = static_cast<int>(std::ceil(2.0 * pi * radius / step));
        const double area = 2.0 * pi * radius * length / (static_cast<double>(along) * around);
        std::complex<double> sum = 0.0;
        for (int i = 0; i < along; ++i) {
            for (int j = 0; j < around; ++j) {
                const double place = (i + 0.5) / along - 0.5;
                const Eigen::Vector3d p = at(place, 2.0 * pi * j / around);
                const Eigen::Vector3d n = (p - middle - place * length * axis) / radius;
                const double r = p.norm();
                const double cosine = -n.dot(p) / r;
                if (cosine > 0.0)
                    sum += std::polar(area * cosine / (r * r), 4.0 * pi / wavelength * r);
            }
        }
        return std::sqrt(static_cast<double>(cylinder_reflection)) * std::abs(sum) / wavelength;
    }
};

/// The largest level of the image of a sonar that looks along `axis`, without absorption.
double cylinder_level_db(Sonar sonar, const Scene& scene, EngineKind type, double range_m) {
    find_targets({&sonar, 1}, scene);
    EngineSettings settings;
    settings.type = type;
    const auto engine = make_engine(scene, settings);
    const TracedPing traced =
        trace_ping(sonar.settings, scene, *engine, Pose{}, direct_echoes_alone);
    const std::vector<float> image =
        form_image(traced, sonar.settings, scene, {}, direct_echoes_alone).intensity;
    return db_of_power(*std::ranges::max_element(image) + 1e-30F) +
           2.0 * calibrated_model_of(sonar).absorption_db_per_m * range_m;
}

Sonar sonar_before_cylinder(SonarKind kind, double frequency) {
    SonarConfig config = calibrated(default_sonar(kind), frequency);
    if (kind == SonarKind::sidescan) {
        config.elevation_deg = 6.0;
        config.instrument.beam.tilt_deg = 30.0;
    } else {
        config.azimuth_deg = 20.0;
        config.elevation_deg = 20.0;
        config.azimuth_bins = 61;
    }
    config.range_min_m = 10.0;
    config.range_max_m = 30.0;
    config.range_bins = 200;
    config.instrument = bare(config.instrument);
    config.instrument.beam.width_deg = 3.0;
    config.instrument.pulse.resolution_m = 0.3;
    return make_sonar(config, {});
}

}  // namespace

TEST_SUITE("calibrated") {
    // Broadside and far away the integral is 10 log(R a L^2 / (2 lambda)) - 40 log r.
    TEST_CASE("cylinders: the Kirchhoff integral in any sonar, by any engine") {
        for (std::uint32_t trial = 0; trial < 20; ++trial) {
            Draws draws(7100 + trial);
            const SonarKind kind = cylinder_kinds[trial % 5];
            const Sonar sonar = sonar_before_cylinder(kind, draws.between(1e5F, 4e5F));
            const double wavelength = calibrated_model_of(sonar).wavelength_m;
            const double azimuth = kind == SonarKind::sidescan ? radians(60.0) : 0.0;
            const Eigen::Vector3d look(std::cos(azimuth), std::sin(azimuth), 0.0);
            Cylinder cylinder;
            cylinder.radius = draws.scale(0.02F, 0.2F);
            const bool broadside = trial % 2 == 0;
            // Off broadside the rims of a short one add what the line leaves out, up to 2 dB.
            cylinder.length = draws.between(broadside ? 4.0F : 12.0F, 25.0F) * wavelength;
            cylinder.sides = draws.whole(16, 96);
            cylinder.roll = draws.between(0.0F, 7.0F);
            const double turn = draws.between(0.0F, 6.3F);
            // The first null is at b = pi.
            const double b = broadside ? 0.0 : draws.between(0.0F, 1.5F);
            const double tilt = std::asin(b * wavelength / (2.0 * pi * cylinder.length));
            const Eigen::Vector3d u = look.unitOrthogonal();
            const Eigen::Vector3d broad = std::cos(turn) * u + std::sin(turn) * look.cross(u);
            cylinder.axis = std::cos(tilt) * broad + std::sin(tilt) * look;
            // The specular line is in the middle of a range bin.
            const double range = 12.05 + 0.1 * draws.whole(0, 149);
            cylinder.middle = (range + cylinder.radius) * look;
            const EngineKind engine = cylinder_engines[draws.whole(0, 3)];
            CAPTURE(trial);
            CAPTURE(static_cast<int>(kind));
            CAPTURE(static_cast<int>(engine));
            CAPTURE(cylinder.radius);
            CAPTURE(cylinder.length);
            CAPTURE(cylinder.sides);
            CAPTURE(range);
            CAPTURE(wavelength);
            CAPTURE(b);
            const double found = cylinder_level_db(sonar, cylinder.scene(), engine, range);
            const double points = 20.0 * std::log10(cylinder.kirchhoff(wavelength));
            CHECK(std::fabs(found - points) < 1.0);
            // Beyond the near field, L^2 / lambda.
            if (!broadside || cylinder.length * cylinder.length > 0.3 * wavelength * range)
                continue;
            const double closed =
                10.0 * std::log10(cylinder_reflection * cylinder.radius * cylinder.length *
                                  cylinder.length / (2.0 * wavelength)) -
                40.0 * std::log10(range);
            CHECK(std::fabs(found - closed) < 1.0);
        }
    }
}
