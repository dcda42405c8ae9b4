#include "calibrated/water_column.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrated/decibel.h"
#include "calibrated/levels.h"
#include "calibrated/volume_strengths.h"
#include "core/lanes.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The share of a side-scan sonar's pattern along the track that its view receives, by range; 1 for
/// other sonars, whose weights include the pattern.
double mean_along_track(const std::variant<TransducerBeams, ArrayBeams>& beams, const View& view,
                        double range_m) {
    const auto* const sides = std::get_if<TransducerBeams>(&beams);
    if (sides == nullptr || sides->sides.empty()) return 1.0;
    const double up = sincos(std::min(0.5 * view.elevation_rad, 0.5 * pi)).sin;
    constexpr int steps = 512;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double sine = up * ((2.0 * k + 1.0) / steps - 1.0);
        sum += std::norm(sides->along.at(static_cast<float>(sine), static_cast<float>(range_m)));
    }
    return sum / steps;
}

/// Adds a constant from one range to another to rows of differences, whose running sums are the
/// values. A bin that a border cuts gets its share.
class RowDifferences {
  public:
    RowDifferences(const WaterColumn& water, int rows)
        : first_(water.range_min_m), per_bin_(1.0F / water.bin_m), rows_(rows) {}

    void add(float from_m, float to_m, float value, float* differences) const {
        if (!(to_m > from_m)) return;
        add_from(from_m, value, differences);
        add_from(to_m, -value, differences);
    }

  private:
    void add_from(float range_m, float value, float* differences) const {
        const float at = std::max((range_m - first_) * per_bin_, 0.0F);
        if (at >= static_cast<float>(rows_)) return;
        const float whole = std::floor(at);
        const int row = static_cast<int>(whole);
        const float later = (at - whole) * value;
        differences[row] += value - later;
        differences[row + 1] += later;
    }

    float first_, per_bin_;
    int rows_;
};

/// The stretch of a ray, [from, to], on which its depth lies between two depths. `fall`: its gain
/// in depth per metre.
std::array<float, 2> stretch_between(float depth_m, float fall, float top_m, float bottom_m) {
    const bool inside = depth_m >= top_m && depth_m < bottom_m;
    if (std::fabs(fall) < 1e-6F) return {0.0F, inside ? no_end : 0.0F};
    const float a = (top_m - depth_m) / fall;
    const float b = (bottom_m - depth_m) / fall;
    return {std::max(std::min(a, b), 0.0F), std::max(std::max(a, b), 0.0F)};
}

/// The two channels that a column lies between, and its share of the second one.
struct BetweenChannels {
    int first, second;
    float share;
};

BetweenChannels channels_of(const SightCells& cells, const SineGrid& grid, int column) {
    const double sine = grid.first + column * grid.step;
    const double at = (sine - cells.middle_sine(0)) / cells.sine_step;
    const double inside = std::clamp(at, 0.0, cells.sines - 1.0);
    const int first = std::min(static_cast<int>(inside), cells.sines - 2);
    return {first, first + 1, static_cast<float>(inside - first)};
}

}  // namespace

std::optional<WaterColumn> water_column(const WaterConfig& water, double frequency_hz,
                                        const View& view,
                                        const std::variant<TransducerBeams, ArrayBeams>& beams,
                                        const SonarEquation& equation) {
    const double strength = volume_strength(water, frequency_hz);
    if (strength == 0.0 && water.layers.empty()) return std::nullopt;
    WaterColumn out;
    out.strength = static_cast<float>(strength);
    for (const WaterLayerConfig& layer : water.layers) {
        out.layers.push_back(
            {.top_m = static_cast<float>(layer.depth_m[0]),
             .bottom_m = static_cast<float>(layer.depth_m[1]),
             .strength = static_cast<float>(power_of_db(layer.scattering_db_per_m3))});
    }
    out.sight = std::visit(
        [&](const auto& of_model) { return weighted_cells(of_model, view, equation.elevation); },
        beams);
    out.range_min_m = equation.range_min_m;
    out.bin_m = equation.bin_m;
    const int padded = (equation.rows + lanes - 1) / lanes * lanes;
    out.row_power.resize(padded);
    for (int row = 0; row < equation.rows; ++row) {
        const double range_m = equation.range_min_m + (row + 0.5) * equation.bin_m;
        const double loss = equation.loss_per_m * range_m - equation.ln_headroom;
        const double power = equation.bin_m / (range_m * range_m) * exponential(-loss) *
                             mean_along_track(beams, view, range_m);
        out.row_power[row] = static_cast<float>(std::min<double>(power, max_echo));
    }
    return out;
}

std::vector<float> received_water(const WaterColumn& water, std::span<const float> ends_m,
                                  const Pose& T_world_sensor,
                                  const std::optional<double>& surface_z_m, int rows) {
    // One more row, for the part of a border in the last bin that belongs to the next.
    const std::size_t stride = static_cast<std::size_t>(rows) + 1;
    std::vector<float> out(stride * water.sight.channels);
    const Eigen::Matrix3f R_world_sensor = T_world_sensor.rotation.toRotationMatrix().cast<float>();
    const float depth_m =
        surface_z_m ? static_cast<float>(*surface_z_m - T_world_sensor.translation.z()) : 0.0F;
    const RowDifferences differences(water, rows);
    for (const auto& [channel, cell, weight] : water.sight.weights) {
        float* const of_channel = out.data() + channel * stride;
        const float fall = -R_world_sensor.row(2).dot(water.sight.cells.direction[cell]);
        const auto [begin, surfaced] =
            surface_z_m ? stretch_between(depth_m, fall, 0.0F, no_end) : std::array{0.0F, no_end};
        const float end = std::min(ends_m[cell], surfaced);
        differences.add(begin, end, weight * water.strength, of_channel);
        for (const WaterColumn::Layer& layer : water.layers) {
            const auto [from, to] = stretch_between(depth_m, fall, layer.top_m, layer.bottom_m);
            differences.add(from, std::min(to, end), weight * layer.strength, of_channel);
        }
    }
    for (int channel = 0; channel < water.sight.channels; ++channel) {
        float* const of_channel = out.data() + channel * stride;
        for (int row = 1; row < rows; ++row)
            of_channel[row] += of_channel[row - 1];
    }
    return out;
}

void add_water(const WaterColumn& water, std::span<const float> received, const SineGrid* by_sine,
               PowerForm form, float gain, PhiloxKey key, EchoGrid& grid) {
    const std::size_t stride = static_cast<std::size_t>(grid.rows()) + 1;
    const std::size_t rows = water.row_power.size();
    std::vector<float> mean(rows);
    for (int c = 0; c < grid.columns(); ++c) {
        if (by_sine == nullptr) {
            std::copy_n(received.data() + c * stride, grid.rows(), mean.begin());
        } else {
            const auto [first, second, share] = channels_of(water.sight.cells, *by_sine, c);
            const float* const one = received.data() + first * stride;
            const float* const other = received.data() + second * stride;
            const auto step = static_cast<float>(by_sine->step);
            for (int row = 0; row < grid.rows(); ++row)
                mean[row] = step * std::fma(share, other[row] - one[row], one[row]);
        }
        for (std::size_t row = 0; row < rows; ++row)
            mean[row] *= water.row_power[row];
        add_drawn(form, mean, gain, c, key, grid);
    }
}

}  // namespace sonarsim
