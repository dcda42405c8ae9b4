#include "calibrated/model.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "calibrated/decibel.h"
#include "core/elementary.h"
#include "core/units.h"
#include "support/approx.h"
#include "support/calibrated.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr int bins = 200;
constexpr int beams_of_fan = 65;
constexpr double fan_rad = 0.6;

View view_of_fan() {
    return {.azimuth_rad = fan_rad,
            .elevation_rad = 1.2,
            .range_min_m = 3.0,
            .range_max_m = 5.0,
            .range_bins = bins,
            .beams = beams_of_fan};
}

InstrumentConfig instrument() {
    InstrumentConfig out = bare({});
    out.frequency_hz = 9e5;
    out.beam.width_deg = 1.0;
    out.speckle.mode = SpeckleMode::scene;
    return out;
}

CalibratedModel model_of(const InstrumentConfig& config) {
    std::vector<double> sines;
    for (int j = 0; j < beams_of_fan; ++j)
        sines.push_back(std::sin(((j + 0.5) / beams_of_fan - 0.5) * fan_rad));
    return calibrated_model(config, {}, view_of_fan(), {.middles = sines, .edges = {}});
}

/// A small plate that faces the sonar straight ahead.
Sample plate(double range_m, double area_m2) {
    const auto r = static_cast<float>(range_m);
    const auto half = static_cast<float>(0.5 * std::sqrt(area_m2));
    return {.position = {r, 0.0F, 0.0F},
            .edge_u = {0.0F, half, 0.0F},
            .edge_v = {0.0F, 0.0F, half},
            .normal = {-1.0F, 0.0F, 0.0F},
            .height_m = r,
            .area_m2 = static_cast<float>(area_m2),
            .material = 0,
            .instance = 0};
}

/// A floor half a metre below, in patches of a centimetre or so, all around what the fan sees.
Samples floor_below(const Pose& T_world_sensor, double patch_m = 0.01) {
    Samples out;
    const Eigen::Quaterniond R_sensor_world = T_world_sensor.rotation.conjugate();
    const auto half = static_cast<float>(0.5 * patch_m);
    for (double x = 2.5; x < 5.0; x += patch_m) {
        for (double y = -1.6; y < 1.6; y += patch_m) {
            const Eigen::Vector3d p =
                R_sensor_world * (Eigen::Vector3d(x, y, -0.5) - T_world_sensor.translation);
            const auto turned = [&](float dx, float dy) -> Eigen::Vector3f {
                return R_sensor_world.cast<float>() * Eigen::Vector3f(dx, dy, 0.0F);
            };
            if (std::fabs(std::atan2(p.y(), p.x())) > 0.5 * fan_rad) continue;
            out.items.push_back({.position = p.cast<float>(),
                                 .edge_u = turned(half, 0.0F),
                                 .edge_v = turned(0.0F, half),
                                 .normal = {0.0F, 0.0F, 1.0F},
                                 .height_m = 0.5F,
                                 .area_m2 = 4.0F * half * half,
                                 .material = 0,
                                 .instance = 0});
        }
    }
    return out;
}

std::vector<float> image_of(const CalibratedModel& model, const Samples& samples,
                            const Pose& pose = {}, std::uint32_t ping = 0,
                            const Terms& terms = {}) {
    return image_of_samples(model, view_of_fan(), samples, terms, pose, {1, 2, ping});
}

float at(const std::vector<float>& image, int row, int beam) {
    return image[static_cast<std::size_t>(row) * beams_of_fan + beam];
}

double sum_of(const std::vector<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0);
}

/// Powers by their mean, `expected`, of the inner part of an image.
std::vector<double> normalised(const std::vector<float>& image, const std::vector<float>& expected,
                               int row_step, int beam_step, int shift = 0) {
    std::vector<double> out;
    for (int row = 20; row < bins - 20; row += row_step) {
        for (int j = 8; j < beams_of_fan - 8; j += beam_step)
            out.push_back(at(image, row, j + shift) / at(expected, row, j + shift));
    }
    return out;
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("calibrated: the level of a plate is the sonar equation's") {
        InstrumentConfig config = instrument();
        config.speckle.mode = SpeckleMode::none;
        config.source_level_db = 200.0;
        const CalibratedModel model = model_of(config);
        // In the middle of bin 50, 0.01 m each.
        constexpr double range = 3.505;
        constexpr double area = 1e-5;
        Samples samples;
        samples.items = {plate(range, area)};
        const std::vector<float> image = image_of(model, samples);
        const double slope2 = std::pow(std::tan(radians(10.0)), 2.0);
        const double strength = db_of_power(std::pow(10.0, -2.7) + 0.4 / (8.0 * pi * slope2));
        const double level = 200.0 + strength + db_of_power(area) - 4.0 * db_of_power(range) -
                             2.0 * model.absorption_db_per_m * range;
        CHECK(std::fabs(db_of_power(at(image, 50, 32)) - level) < 0.3);
        CHECK(*std::ranges::max_element(image) == at(image, 50, 32));
    }

    TEST_CASE("calibrated: levels fall by spreading and absorption, and TVG makes up for it") {
        InstrumentConfig config = instrument();
        config.speckle.mode = SpeckleMode::none;
        Samples near, far;
        near.items = {plate(3.205, 1e-5)};
        far.items = {plate(4.805, 1e-5)};
        const CalibratedModel plain = model_of(config);
        const double loss =
            4.0 * db_of_power(4.805 / 3.205) + 2.0 * plain.absorption_db_per_m * (4.805 - 3.205);
        const double fall = db_of_power(at(image_of(plain, near), 20, 32)) -
                            db_of_power(at(image_of(plain, far), 180, 32));
        CHECK(std::fabs(fall - loss) < 0.01);
        config.receiver.tvg_log = 40.0;
        config.receiver.tvg_absorption = true;
        const CalibratedModel gained = model_of(config);
        CHECK(std::fabs(at(image_of(gained, near), 20, 32) / at(image_of(gained, far), 180, 32) -
                        1.0) < 1e-3);
        // Nearer than 4 m it is that of 4 m.
        config.receiver.tvg_from_m = 4.0;
        const CalibratedModel late = model_of(config);
        CHECK(late.row_gain[20] == late.row_gain[0]);
        CHECK(late.row_gain[180] == gained.row_gain[180]);
        CHECK(std::fabs(db_of_power(late.row_gain[180] / late.row_gain[20]) -
                        4.0 * db_of_power(4.805 / 4.0) -
                        2.0 * late.absorption_db_per_m * (4.805 - 4.0)) < 1e-3);
    }

    TEST_CASE("calibrated: speckle is exponential in power, with the mean of the image without") {
        InstrumentConfig config = instrument();
        const Samples samples = floor_below({});
        config.speckle.mode = SpeckleMode::none;
        const std::vector<float> expected = image_of(model_of(config), samples);
        for (const SpeckleMode mode : {SpeckleMode::scene, SpeckleMode::ping}) {
            config.speckle.mode = mode;
            const std::vector<float> image = image_of(model_of(config), samples);
            CHECK(std::fabs(sum_of(image) / sum_of(expected) - 1.0) < 0.06);
            // Every third bin and sixth beam: farther apart than what the instrument smears.
            std::vector<double> powers = normalised(image, expected, 3, 6);
            const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) /
                                static_cast<double>(powers.size());
            std::ranges::sort(powers);
            const auto n = static_cast<double>(powers.size());
            double distance = 0.0;
            for (std::size_t i = 0; i < powers.size(); ++i) {
                const double below = 1.0 - std::exp(-powers[i] / mean);
                distance = std::max({distance, std::fabs(below - static_cast<double>(i) / n),
                                     std::fabs(below - static_cast<double>(i + 1) / n)});
            }
            // Kolmogorov and Smirnov at 1 %.
            CHECK(distance < 1.63 / std::sqrt(n));
        }
    }

    TEST_CASE("calibrated: scatterers stay, and turn with the sonar as the beams do") {
        InstrumentConfig config = instrument();
        config.beam.spread = BeamSpacing::equal_angle;
        config.speckle.mode = SpeckleMode::none;
        const Pose here;
        const Samples samples = floor_below(here);
        const std::vector<float> expected = image_of(model_of(config), samples);
        config.speckle.mode = SpeckleMode::scene;
        const CalibratedModel model = model_of(config);
        const std::vector<float> first = image_of(model, samples, here, 0);
        const Terms quiet{.random = 1};
        CHECK(image_of(model, samples, here, 0, quiet) == image_of(model, samples, here, 1, quiet));

        // Nor does it matter how the surface is cut.
        const std::vector<float> otherwise = image_of(model, floor_below(here, 0.0172), here, 0);
        CHECK(test::correlation(normalised(first, expected, 1, 1),
                                normalised(otherwise, expected, 1, 1)) > 0.98);

        // A turn by one beam to port: the echo of beam j is in beam j - 1.
        const Pose turned{rotation_from_rpy(0.0, 0.0, fan_rad / beams_of_fan),
                          Eigen::Vector3d::Zero()};
        const std::vector<float> second = image_of(model, floor_below(turned), turned, 1);
        const std::vector<double> a = normalised(first, expected, 1, 1);
        CHECK(test::correlation(a, normalised(second, expected, 1, 1, -1)) > 0.88);
        CHECK(test::correlation(a, normalised(second, expected, 1, 1, 3)) < 0.1);

        // Sideways by d, transmitter and receiver alike, sound comes to the array as if it had
        // moved by 2 d. The part 1 - 2 d / L of a uniform aperture L is left, and the correlation
        // of powers is its square.
        const double aperture_m = 0.8859 * model.wavelength_m / radians(1.0);
        const auto moved = [&](double share) {
            const Pose pose{here.rotation, Eigen::Vector3d(0.0, share * aperture_m, 0.0)};
            return test::correlation(
                a, normalised(image_of(model, floor_below(pose), pose), expected, 1, 1));
        };
        for (const double share : {0.05, 0.15, 0.3}) {
            const double left = 1.0 - 2.0 * share;
            CHECK(std::fabs(moved(share) - left * left) < 0.06);
        }

        config.speckle.mode = SpeckleMode::ping;
        const CalibratedModel drawn = model_of(config);
        CHECK(std::fabs(test::correlation(
                  normalised(image_of(drawn, samples, here, 0), expected, 1, 1),
                  normalised(image_of(drawn, samples, here, 1), expected, 1, 1))) < 0.06);
    }
}
