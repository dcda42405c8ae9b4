#include "simulate/calibrated/bottom.h"

#include "support/test.h"

using namespace sonarsim;

TEST_SUITE("calibrated") {
    TEST_CASE("bottom: Lambert's rule away from normal incidence, facets near it") {
        const Backscatter sand = backscatter(-27.0, 0.1, std::tan(radians(10.0)));
        // At 30 degrees of grazing the facets are gone.
        CHECK(std::fabs(sand.at(0.5F) / (std::pow(10.0, -2.7) * 0.25) - 1.0) < 1e-4);
        // Facets reflect what Lambert's rule leaves.
        const double s2 = std::tan(radians(10.0)) * std::tan(radians(10.0));
        const double mu = std::pow(10.0, -2.7);
        CHECK(std::fabs(sand.at(1.0F) / (mu + 0.1 * (1.0 - pi * mu) / (8.0 * pi * s2)) - 1.0) <
              1e-5);
        CHECK(backscatter(-4.0, 0.9, 0.1).facet == 0.0F);
    }

    TEST_CASE("bottom: exp_neg is e^-x") {
        for (float x = 0.0F; x < 40.0F; x += 0.037F)
            CHECK(std::fabs(exp_neg(x) / std::exp(-static_cast<double>(x)) - 1.0) < 1e-5);
    }

    TEST_CASE("bottom: both ways along one direction are one, and facets send on what they meet") {
        const double slope = std::tan(radians(4.0));
        const Backscatter rock = backscatter(-27.0, 0.4, slope);
        for (const float sine : {0.1F, 0.6F, 0.99F})
            CHECK(std::fabs(rock.between(sine, sine, sine) / rock.at(sine) - 1.0F) < 1e-5F);

        // Facets meet the part v . n of the sound and send on R of it, over all directions.
        const Backscatter facets = backscatter(-300.0, 0.4, slope);
        const double in = radians(60.0);  // grazing angle
        double sent = 0.0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i) {
            const double elevation = (i + 0.5) * 0.5 * pi / steps;
            for (int j = 0; j < 4 * steps; ++j) {
                const double azimuth = (j + 0.5) * 2.0 * pi / (4 * steps);
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
