#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "support/draws.h"
#include "support/maps.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/smooth_shapes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

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

}  // namespace

TEST_SUITE("calibrated") {
    // Broadside and far away the integral is 10 log(R a L^2 / (2 lambda)) - 40 log r.
    TEST_CASE("cylinders: the Kirchhoff integral in any sonar, by any engine" *
              doctest::skip(test::sanitized)) {
        for (std::uint32_t trial = 0; trial < 20; ++trial) {
            Draws draws(7100 + trial);
            const SonarKind kind = kinds_before_shapes[trial % 5];
            const Looking from = looking(kind, draws.between(1e5F, 4e5F));
            const double wavelength = from.wavelength();
            const Eigen::Vector3d& look = from.axis;
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
            const EngineKind engine = engines_before_shapes[draws.whole(0, 3)];
            CAPTURE(trial);
            CAPTURE(static_cast<int>(kind));
            CAPTURE(static_cast<int>(engine));
            CAPTURE(cylinder.radius);
            CAPTURE(cylinder.length);
            CAPTURE(cylinder.sides);
            CAPTURE(range);
            CAPTURE(wavelength);
            CAPTURE(b);
            const double found = peak_db(from, cylinder.scene(), engine, range);
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

    TEST_CASE("cylinders: with maps the texel on their line reflects") {
        const Looking from = looking(SonarKind::imaging, 2e5);
        const double range = 20.05;
        const Cylinder cylinder{.middle = (range + 0.1) * from.axis,
                                .axis = from.axis.unitOrthogonal(),
                                .radius = 0.1,
                                .length = 15.0 * from.wavelength(),
                                .sides = 48,
                                .roll = 0.3};
        const double smooth_db = peak_db(from, cylinder.scene(), EngineKind::slices, range);
        const auto mapped_db = [&](bool own_smooth, bool texel_smooth, float strength) {
            Scene scene = cylinder.scene();
            const std::uint32_t rough = add_material(scene, cylinder_reflection);
            if (!own_smooth) scene.triangle_material.assign(scene.triangles.size(), rough);
            const TexelFrame frame = square_frame(1, 100.0);
            lay(scene,
                material_texels(frame, {texel_smooth ? 0U : rough},
                                [](int, int) { return std::uint16_t{0}; }),
                strengths(frame, [&](int, int) { return strength; }));
            return peak_db(from, scene, EngineKind::slices, range);
        };
        for (const bool own_smooth : {false, true}) {
            CHECK(std::fabs(mapped_db(own_smooth, true, 1.0F) - smooth_db) < 0.01);
            CHECK(std::fabs(mapped_db(own_smooth, true, 4.0F) - smooth_db - 6.0206) < 0.01);
            CHECK(mapped_db(own_smooth, false, 1.0F) < smooth_db - 10.0);
        }
    }
}
