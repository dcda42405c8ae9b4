#include "calibrated/bottom.h"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "core/units.h"

using namespace sonarsim;

TEST_SUITE("calibrated") {
    TEST_CASE("bottom: Lambert's rule away from normal incidence, facets near it") {
        const Backscatter sand = backscatter(-27.0, 0.1, std::tan(radians(10.0)));
        // At 30 degrees of grazing, tan^2 of incidence 3: the facets are gone.
        CHECK(std::fabs(sand.at(0.5F) / (std::pow(10.0, -2.7) * 0.25) - 1.0) < 1e-4);
        // Facets reflect what Lambert's rule leaves.
        const double s2 = std::tan(radians(10.0)) * std::tan(radians(10.0));
        const double mu = std::pow(10.0, -2.7);
        CHECK(std::fabs(sand.at(1.0F) / (mu + 0.1 * (1.0 - pi * mu) / (8.0 * pi * s2)) - 1.0) <
              1e-5);
        CHECK(backscatter(-4.0, 0.9, 0.1).facet == 0.0F);
    }

    TEST_CASE("bottom: facets send back what they reflect") {
        // Facets of slopes p(sx, sy) dsx dsy reflect R of what meets them into 4 cos(theta) times
        // the solid angle of their normals; backscattered from all directions that is, for small
        // slopes, the integral over directions of sigma = R / 4.
        const Backscatter smooth = backscatter(-200.0, 0.36, std::tan(radians(3.0)));
        double sum = 0.0;
        constexpr double step = 1e-4;
        for (double theta = 0.5 * step; theta < 0.5; theta += step)
            sum +=
                smooth.at(static_cast<float>(std::cos(theta))) * 2.0 * pi * std::sin(theta) * step;
        CHECK(std::fabs(sum / (0.36 / 4.0) - 1.0) < 0.03);
    }

    TEST_CASE("bottom: exp_neg is e^-x") {
        for (float x = 0.0F; x < 40.0F; x += 0.037F)
            CHECK(std::fabs(exp_neg(x) / std::exp(-static_cast<double>(x)) - 1.0) < 1e-5);
    }

    TEST_CASE("bottom: along one direction the two are one, and facets send on what they meet") {
        const double slope = std::tan(radians(4.0));
        const Backscatter rock = backscatter(-27.0, 0.4, slope);
        for (const float sine : {0.1F, 0.6F, 0.99F})
            CHECK(std::fabs(rock.between(sine, sine, sine) / rock.at(sine) - 1.0F) < 1e-5F);

        // Facets of Gaussian slopes zeta with normals h meet, by area of the mean plane, the part
        // (v . h) / (n . h) of the sound, whose mean is v . n, for that of zeta is 0. With R they
        // send on R v . n in all.
        const Backscatter facets = backscatter(-300.0, 0.4, slope);
        const double in = radians(60.0);  // grazing angle
        double sent = 0.0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i) {
            const double elevation = (i + 0.5) * 0.5 * pi / steps;
            for (int j = 0; j < 4 * steps; ++j) {
                const double azimuth = (j + 0.5) * 2.0 * pi / (4 * steps);
                // v = (cos in, 0, sin in), and where the sound goes to.
                const Eigen::Vector3d sum(std::cos(in) + std::cos(elevation) * std::cos(azimuth),
                                          std::cos(elevation) * std::sin(azimuth),
                                          std::sin(in) + std::sin(elevation));
                const float half = static_cast<float>(sum.z() / sum.norm());
                sent += facets.between(static_cast<float>(std::sin(in)),
                                       static_cast<float>(std::sin(elevation)), half) *
                        std::cos(elevation) * (0.5 * pi / steps) * (2.0 * pi / (4 * steps));
            }
        }
        CHECK(std::fabs(sent / (0.4 * std::sin(in)) - 1.0) < 0.01);
    }
}
