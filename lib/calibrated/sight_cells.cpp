#include "calibrated/sight_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/lanes.h"
#include "core/units.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr double cell_rad = radians(1.0);
constexpr int min_cell_count = 4;
constexpr int max_cells = 128;
constexpr int cone_rings = 48;
constexpr int cone_turns = 16;
// The number of directions along either side over which a cell is integrated.
constexpr int parts = 4;
// The range at which a transducer is in its far field, m.
constexpr float far_m = 1e6F;

int cells_over(double extent) {
    return std::clamp(static_cast<int>(std::ceil(extent / cell_rad)), min_cell_count, max_cells);
}

/// The axis of symmetry, then the two axes from which the turn is measured.
std::array<int, 3> axes_of(int axis) {
    if (axis == 1) return {1, 0, 2};
    return axis == 2 ? std::array{2, 0, 1} : std::array{0, 1, 2};
}

Eigen::Vector3f direction_of(int axis, double sine, double turn_rad) {
    const SinCos turn = sincos(turn_rad);
    const double across = std::sqrt(std::max(1.0 - sine * sine, 0.0));
    const auto [along, first, second] = axes_of(axis);
    Eigen::Vector3f out;
    out[along] = static_cast<float>(sine);
    out[first] = static_cast<float>(across * turn.cos);
    out[second] = static_cast<float>(across * turn.sin);
    return out;
}

bool is_in_view(const View& view, const Eigen::Vector3f& direction) {
    if (view.shape == ViewShape::cone) return direction.x() >= sincos(0.5 * view.elevation_rad).cos;
    return std::fabs(direction.z()) <= sincos(std::min(0.5 * view.elevation_rad, 0.5 * pi)).sin &&
           std::fabs(arctan2(direction.y(), direction.x())) <= 0.5 * view.azimuth_rad;
}

SightCells empty_cells(int axis, double low_sine, double high_sine, double turn_rad, int sines,
                       int turns) {
    SightCells out;
    out.axis = axis;
    out.sines = sines;
    out.turns = turns;
    out.first_sine = static_cast<float>(low_sine);
    out.sine_step = static_cast<float>((high_sine - low_sine) / sines);
    out.first_turn_rad = static_cast<float>(-turn_rad);
    out.turn_step_rad = static_cast<float>(2.0 * turn_rad / turns);
    return out;
}

/// The cells about y between two sines, up to the view's elevation.
SightCells cells_about_y(const View& view, double low_sine, double high_sine) {
    const double most = std::max(std::fabs(low_sine), std::fabs(high_sine));
    const double across = std::sqrt(std::max(1.0 - most * most, 0.0));
    const double up = sincos(std::min(0.5 * view.elevation_rad, 0.5 * pi)).sin;
    double turn = up < across ? arcsin(up / across) : 0.5 * pi;
    if (view.azimuth_rad > pi) turn = pi;
    return empty_cells(1, low_sine, high_sine, turn, cells_over(high_sine - low_sine),
                       cells_over(2.0 * turn));
}

/// Fills the cells, and adds the weights of their directions by weigh(block, echoes, channel),
/// which multiplies the powers of a block by the pattern of a channel.
template <class Weigh>
void add_weights(const View& view, int channels, bool by_sine, Weigh weigh, WeightedCells& out) {
    SightCells& cells = out.cells;
    const double part_sr =
        double{cells.sine_step} * cells.turn_step_rad / (static_cast<double>(parts) * parts);
    out.channels = by_sine ? cells.sines : channels;
    for (int cell = 0; cell < cells.count(); ++cell) {
        const int s = cell / cells.turns;
        const int t = cell % cells.turns;
        PatchBlock block;
        for (int k = 0; k < parts * parts; ++k) {
            const int row = k / parts;
            const int column = k % parts;
            const double sine = cells.first_sine + (s + (row + 0.5) / parts) * cells.sine_step;
            const double turn =
                cells.first_turn_rad + (t + (column + 0.5) / parts) * cells.turn_step_rad;
            const Eigen::Vector3f direction = direction_of(cells.axis, sine, turn);
            if (!is_in_view(view, direction)) continue;
            const Eigen::Vector3f place = far_m * direction;
            block.x[block.count] = place.x();
            block.y[block.count] = place.y();
            // A side-scan sonar's pattern along the track is left out.
            block.z[block.count] = cells.axis == 2 ? 0.0F : place.z();
            ++block.count;
        }
        const double middle_sine = cells.first_sine + (s + 0.5) * cells.sine_step;
        const double middle_turn = cells.first_turn_rad + (t + 0.5) * cells.turn_step_rad;
        cells.direction.push_back(direction_of(cells.axis, middle_sine, middle_turn));
        cells.visible_sr.push_back(static_cast<float>(part_sr * block.count));
        if (block.count == 0) continue;
        for (int channel = 0; channel < channels; ++channel) {
            PointEchoes echoes{};
            echoes.count = block.count;
            std::fill_n(echoes.range_m.begin(), block.count, far_m);
            std::fill_n(echoes.power.begin(), block.count, 1.0F);
            weigh(block, echoes, channel);
            double sum = 0.0;
            for (int k = 0; k < block.count; ++k)
                sum += echoes.power[k];
            const double weight = sum * part_sr / (by_sine ? double{cells.sine_step} : 1.0);
            if (weight > 0.0)
                out.weights.push_back({by_sine ? s : channel, cell, static_cast<float>(weight)});
        }
    }
}

}  // namespace

int SightCells::spanned(const Eigen::Vector3f& half_edge, const Eigen::Vector3f& towards,
                        float range_m) const {
    constexpr float most = 64.0F;
    const auto [along, first, second] = axes_of(axis);
    const Eigen::Vector3f moved = (2.0F / range_m) * half_edge;
    const float sine = std::fabs(moved[along] - moved.dot(towards) * towards[along]);
    const float across2 = 1.0F - towards[along] * towards[along];
    const float turn = std::fabs(towards[first] * moved[second] - towards[second] * moved[first]);
    const float by_turn = turn / std::max(across2 * turn_step_rad, 1e-6F);
    return static_cast<int>(std::ceil(std::clamp(std::max(sine / sine_step, by_turn), 1.0F, most)));
}

void SightCells::find(SightPlaces& places) const {
    const std::array<const float*, 3> place{places.x.data(), places.y.data(), places.z.data()};
    const auto [along, first, second] = axes_of(axis);
    const float* const on_axis = place[along];
    const float* const on_first = place[first];
    const float* const on_second = place[second];
    std::array<float, SightPlaces::most> s, t;
    const int count = (places.count + lanes - 1) / lanes * lanes;
    for (int k = 0; k < count; ++k) {
        const float range = arrival_at(places.x[k], places.y[k], places.z[k]).range_m;
        places.range_m[k] = range;
        s[k] = (on_axis[k] / range - first_sine) / sine_step;
        t[k] = (arctan2_float(on_second[k], on_first[k]) - first_turn_rad) / turn_step_rad;
    }
    for (int k = 0; k < count; k += lanes) {
        const Floats8 row = Floats8::load(s.data() + k);
        const Floats8 column = Floats8::load(t.data() + k);
        const Mask8 inside = (row >= 0.0F) & (row < static_cast<float>(sines)) &
                             ((column >= 0.0F) & (column < static_cast<float>(turns)));
        const Ints8 number = to_ints(row) * turns + to_ints(column);
        (where(inside, number + 1) - 1).store(places.cell.data() + k);
    }
}

WeightedCells weighted_cells(const ArrayBeams& beams, const View& view,
                             const ElevationPattern& elevation) {
    const SineGrid& grid = beams.amplitudes.grid();
    const double last = grid.first + (grid.columns - 1) * grid.step;
    WeightedCells out;
    out.cells = cells_about_y(view, std::max(grid.first, -1.0), std::min(last, 1.0));
    const auto weigh = [&](const PatchBlock& block, PointEchoes& echoes, int /*channel*/) {
        weigh_by_elevation(elevation, block, block.count, echoes);
    };
    add_weights(view, 1, true, weigh, out);
    return out;
}

WeightedCells weighted_cells(const TransducerBeams& beams, const View& view,
                             const ElevationPattern& elevation) {
    WeightedCells out;
    const double half_azimuth = std::min(0.5 * view.azimuth_rad, pi);
    if (view.shape == ViewShape::cone) {
        const double edge = sincos(0.5 * view.elevation_rad).cos;
        out.cells = empty_cells(0, edge, 1.0, pi, cone_rings, cone_turns);
    } else if (view.shape == ViewShape::port_starboard) {
        const double up = sincos(std::min(0.5 * view.elevation_rad, 0.5 * pi)).sin;
        out.cells = empty_cells(2, -up, up, half_azimuth, 1, cells_over(2.0 * half_azimuth));
    } else {
        const double side = half_azimuth < 0.5 * pi ? sincos(half_azimuth).sin : 1.0;
        out.cells = cells_about_y(view, -side, side);
    }
    const auto weigh = [&](const PatchBlock& block, PointEchoes& echoes, int channel) {
        PatchBlock::Array<float> gains{};
        find_gains(beams, channel, block, echoes, gains);
        weigh_by_elevation(elevation, block, block.count, echoes);
        for (int k = 0; k < block.count; ++k)
            echoes.power[k] *= gains[k];
    };
    add_weights(view, beams.beams(), false, weigh, out);
    return out;
}

}  // namespace sonarsim
