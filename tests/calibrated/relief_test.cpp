#include "simulate/calibrated/relief.h"

#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr Water sea{1000.0, 1500.0};
constexpr double away_m = 12.0;

Material sand() {
    Material out;
    out.grain_phi = 1.5;
    return out;
}

/// The factors of the relief on a level bed at drawn places, at the grazing angle; the sonar looks
/// along the direction.
std::vector<double> factors(double grazing_rad, double direction_rad, PhiloxKey key) {
    const std::vector<Material> materials{Material{}, sand()};
    const Relief relief(materials, sea, 1.0);
    std::mt19937 draws(7);
    std::uniform_real_distribution<double> place(-500.0, 500.0);
    std::vector<double> out;
    PatchBlock pieces;
    PointEchoes echoes;
    const Eigen::Vector3d ahead(std::cos(grazing_rad) * std::cos(direction_rad),
                                std::cos(grazing_rad) * std::sin(direction_rad),
                                -std::sin(grazing_rad));
    for (int k = 0; k < 40000; ++k) {
        const double x = place(draws);
        const double y = place(draws);
        SonarInScene sonar;
        sonar.sensor = Eigen::Vector3d(x, y, 0.0) - away_m * ahead;
        pieces.count = echoes.count = 2;
        for (int of = 0; of < 2; ++of) {
            pieces.x[of] = static_cast<float>(away_m * ahead.x());
            pieces.y[of] = static_cast<float>(away_m * ahead.y());
            pieces.z[of] = static_cast<float>(away_m * ahead.z());
            pieces.height_m[of] = static_cast<float>(away_m * std::sin(grazing_rad));
            pieces.material[of] = static_cast<std::uint32_t>(of);
            echoes.range_m[of] = static_cast<float>(away_m);
            echoes.power[of] = 1.0F;
        }
        add_relief(pieces, relief, sonar, key, echoes);
        CHECK(echoes.power[0] == 1.0F);  // no sea bed
        out.push_back(static_cast<double>(echoes.power[1]));
    }
    return out;
}

/// c of the page, of sand: height 1.466 by the regression of APL-UW TR 9407 for 1.5 phi, so that
/// the spectrum is 0.00207 1.466^2 = 0.00445 cm^4 at 1 rad/cm and falls as K^-3.25. Waves longer
/// than 10 cm have K below 0.628 rad/cm.
double contrast(double grazing_rad) {
    const double height = (2.03846 - 0.26923 * 1.5) / (1.0 + 0.076923 * 1.5);
    const double slope =
        std::sqrt(pi * 0.00207 * height * height / 0.75 * std::pow(2.0 * pi / 10.0, 0.75));
    return std::min(1.0, 2.0 * slope / std::tan(grazing_rad));
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("relief: factors have the mean 1 and the variance exp(c^2) - 1") {
        for (const double grazing_deg : {15.0, 30.0, 60.0}) {
            const double c = contrast(radians(grazing_deg));
            const std::vector<double> found = factors(radians(grazing_deg), 0.4, {11, 22});
            const double average = mean(found);
            double squares = 0.0;
            for (const double factor : found)
                squares += factor * factor / static_cast<double>(found.size());
            CAPTURE(grazing_deg);
            // The square has about 128^2 independent waves of 10 cm, and longer ones: 4.5 standard
            // errors of their mean, and of their second moment.
            const double variance = std::exp(c * c) - 1.0;
            CHECK(std::fabs(average - 1.0) < 4.5 * std::sqrt(variance) / 100.0);
            CHECK(std::fabs(squares / (1.0 + variance) - 1.0) <
                  4.5 * std::sqrt(std::exp(4.0 * c * c) - 1.0) / 100.0);
        }
    }

    TEST_CASE("relief: what is bright from one side is dark from the other") {
        // exp(c t - c^2 / 2) exp(-c t - c^2 / 2) = exp(-c^2). The sonar may stand anywhere.
        const double grazing = radians(25.0);
        const std::vector<double> there = factors(grazing, 1.1, {3, 4});
        const std::vector<double> back = factors(grazing, 1.1 + pi, {3, 4});
        const double expected = std::exp(-std::pow(contrast(grazing), 2.0));
        int off = 0;
        for (std::size_t k = 0; k < there.size(); ++k)
            off += std::fabs(there[k] * back[k] / expected - 1.0) > 1e-3 ? 1 : 0;
        // Places are floats: one in 600 lies on the border of a texel.
        CHECK(off < static_cast<int>(there.size()) / 200);
    }
}
