#include "calibrate/soundings_fit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "calibrate/made_pings.h"
#include "core/error.h"
#include "core/normal_pair.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Soundings of a flat bottom 10 m below, with ranges that are off by normal numbers, heave of 0.3
/// m from ping to ping, and amplitudes of Lambert's rule: the power falls by cos^2 of the angle,
/// and the geometry adds its part.
std::vector<RecordedSoundings> made_soundings(int pings, double spread_m,
                                              const SoundingsGeometry& geometry) {
    std::vector<RecordedSoundings> out;
    const PhiloxKey key = stream_key(5, 1, 0, stream_named("made soundings"));
    for (int k = 0; k < pings; ++k) {
        RecordedSoundings ping;
        const double depth = 10.0 + 0.3 * std::sin(0.3 * k);
        for (int j = 0; j < 120; ++j) {
            const double angle = radians(-59.5 + j);
            const double range = depth / std::cos(angle);
            const PhiloxBlock block =
                philox({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(j), 0, 0}, key);
            const double off = spread_m * normal_pair(block.x0).first;
            const double level_db = 40.0 + 20.0 * std::log10(std::cos(angle)) +
                                    geometry.gain_db(std::fabs(angle), range);
            ping.range_m.push_back(static_cast<float>(range + off));
            ping.angle_rad.push_back(static_cast<float>(angle));
            ping.intensity.push_back(static_cast<float>(std::pow(10.0, 0.05 * level_db)));
        }
        out.push_back(std::move(ping));
    }
    return out;
}

}  // namespace

TEST_SUITE("calibrate") {
    TEST_CASE("soundings: spread and strength of a flat bottom, whatever the heave") {
        const SoundingsGeometry geometry{0.05, radians(1.0), 30.0};
        const RecordedLaw law{.kind = RecordedLaw::Kind::amplitude, .full_value = 0.0};
        const SoundingsFit fit =
            fit_soundings(made_soundings(60, 0.02, geometry), law, 0.0, geometry);
        REQUIRE(fit.angles_rad.size() == 15);
        for (std::size_t k = 0; k < fit.angles_rad.size(); ++k) {
            CAPTURE(degrees(fit.angles_rad[k]));
            // 480 soundings of each angle, correlated over three beams: 5 % each, five of them.
            CHECK(std::fabs(fit.spread_m[k].value - 0.02) < 0.005);
            const double rule = 40.0 + 20.0 * std::log10(std::cos(fit.angles_rad[k]));
            CHECK(std::fabs(fit.strength_db[k].value - rule) < 0.2);
        }
        // Lambert's rule without facets: what they add at normal incidence is small.
        CHECK(std::fabs(fit.lambert_db.value - 40.0) < 0.5);
        CHECK(fit.facets_db.value < -6.0);
    }

    TEST_CASE("soundings: too few are refused") {
        const SoundingsGeometry geometry{0.05, radians(1.0), 30.0};
        const RecordedLaw law{.kind = RecordedLaw::Kind::amplitude, .full_value = 0.0};
        CHECK_THROWS_AS(fit_soundings(made_soundings(3, 0.02, geometry), law, 0.0, geometry),
                        InputError);
    }
}
