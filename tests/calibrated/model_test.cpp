#include "simulate/calibrated/model.h"

#include "core/decibel.h"
#include "support/calibrated.h"
#include "support/patches.h"
#include "support/statistics.h"

namespace {

constexpr int bins = 200;
constexpr int beams_of_fan = 65;
constexpr double fan_rad = 0.6;

View view_of_fan() {
    return {fan_rad, 1.2, 3.0, 5.0, bins, beams_of_fan};
}

InstrumentConfig instrument() {
    InstrumentConfig out = bare({});
    out.frequency_hz = 9e5;
    out.beam.width_deg = 1.0;
    out.speckle.mode = SpeckleMode::scene;
    return out;
}

CalibratedModel model_of(const InstrumentConfig& config) {
    const BeamSines sines = fan_sines(degrees(fan_rad), beams_of_fan);
    return calibrated_model(config, {}, view_of_fan(), {.middles = sines.middles, .edges = {}});
}

/// A floor half a metre below, in patches of a centimetre or so, all around what the fan sees.
Samples floor_below(double patch_m = 0.01) {
    Samples out;
    const auto half = static_cast<float>(0.5 * patch_m);
    for (double x = 2.5; x < 5.0; x += patch_m) {
        for (double y = -1.6; y < 1.6; y += patch_m) {
            if (std::fabs(std::atan2(y, x)) > 0.5 * fan_rad) continue;
            out.items.push_back(patch_of(Eigen::Vector3d(x, y, -0.5).cast<float>(),
                                         {0.0F, 0.0F, 1.0F}, {half, 0.0F, 0.0F},
                                         {0.0F, half, 0.0F}));
        }
    }
    return out;
}

std::vector<float> image_of(const CalibratedModel& model, const Samples& samples,
                            std::uint32_t ping = 0, const Terms& terms = {}) {
    return image_of_samples(model, view_of_fan(), samples, terms, {}, {1, 2, ping});
}

float at(const std::vector<float>& image, int row, int beam) {
    return image[static_cast<std::size_t>(row) * beams_of_fan + beam];
}

/// Powers by their mean, `expected`, of the inner part of an image.
std::vector<double> normalised(const std::vector<float>& image, const std::vector<float>& expected,
                               int row_step, int beam_step) {
    std::vector<double> out;
    for (int row = 20; row < bins - 20; row += row_step) {
        for (int j = 8; j < beams_of_fan - 8; j += beam_step)
            out.push_back(at(image, row, j) / at(expected, row, j));
    }
    return out;
}

}  // namespace

TEST_CASE("calibrated: TVG makes up for spreading and absorption") {
    InstrumentConfig config = instrument();
    config.speckle.mode = SpeckleMode::none;
    Samples near, far;
    near.items = {plate_ahead(3.205, std::sqrt(1e-5))};
    far.items = {plate_ahead(4.805, std::sqrt(1e-5))};
    config.receiver.tvg_log = 40.0;
    config.receiver.tvg_absorption = true;
    const CalibratedModel gained = model_of(config);
    CHECK(std::fabs(at(image_of(gained, near), 20, 32) / at(image_of(gained, far), 180, 32) - 1.0) <
          1e-3);
    // Nearer than 4 m it is that of 4 m.
    config.receiver.tvg_from_m = 4.0;
    const CalibratedModel late = model_of(config);
    CHECK(late.row_gain[20] == late.row_gain[0]);
    CHECK(late.row_gain[180] == gained.row_gain[180]);
    CHECK(std::fabs(db_of_power(late.row_gain[180] / late.row_gain[20]) -
                    4.0 * db_of_power(4.805 / 4.0) -
                    2.0 * late.absorption_db_per_m * (4.805 - 4.0)) < 1e-3);
}

TEST_CASE("calibrated: scatterers stay, however the surface is cut, or are drawn by ping") {
    InstrumentConfig config = instrument();
    config.beam.spread = BeamSpacing::equal_angle;
    const Samples samples = floor_below();
    const auto image_by = [&](SpeckleMode mode, const Samples& surface, std::uint32_t ping) {
        config.speckle.mode = mode;
        return image_of(model_of(config), surface, ping, {.random = 1});
    };
    const std::vector<float> expected = image_by(SpeckleMode::none, samples, 0);
    const std::vector<float> first = image_by(SpeckleMode::scene, samples, 0);
    CHECK(first == image_by(SpeckleMode::scene, samples, 1));
    const auto correlated = [&](const std::vector<float>& a, const std::vector<float>& b) {
        return correlation(normalised(a, expected, 1, 1), normalised(b, expected, 1, 1));
    };
    CHECK(correlated(first, image_by(SpeckleMode::scene, floor_below(0.0172), 0)) > 0.98);
    const std::vector<float> drawn = image_by(SpeckleMode::ping, samples, 0);
    CHECK(std::fabs(correlated(drawn, image_by(SpeckleMode::ping, samples, 1))) < 0.06);
    CHECK(std::fabs(total(drawn) / total(expected) - 1.0) < 0.06);
    // Every third bin and sixth beam: farther apart than what the instrument smears.
    const std::vector<double> powers = normalised(drawn, expected, 3, 6);
    const double level = mean(powers);
    CHECK(ks_p_value(powers, [&](double x) { return 1.0 - std::exp(-x / level); }) > 0.01);
}
