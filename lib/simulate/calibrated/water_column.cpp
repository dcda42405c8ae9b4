#include "simulate/calibrated/water_column.h"

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/lanes.h"
#include "core/units.h"
#include "simulate/calibrated/equation/instrument_levels.h"

namespace sonarsim {

namespace {

/// The parts of volume_strength() by the key `content`.
struct Content {
    double strength = 0.0;  ///< m^2 per m^3
    double suspended_mg_l = 0.0;
};

Content content_of(WaterContent content) {
    switch (content) {
        case WaterContent::clear:
            return {power_of_db(-90.0), 0.5};
        case WaterContent::coastal:
            return {power_of_db(-75.0), 20.0};
        case WaterContent::plankton:
            return {power_of_db(-65.0), 20.0};
        case WaterContent::plume:
            return {power_of_db(-55.0), 0.0};
        case WaterContent::automatic:
        case WaterContent::none:
            break;
    }
    return {};
}

double bell(double x) {
    return exponential(-x * x);
}

/// |f| of sand by x = k a.
double form_function(double x) {
    const double dip = 1.0 - 0.35 * bell((x - 1.5) / 0.7);
    const double rise = 1.0 + 0.5 * bell((x - 1.8) / 2.2);
    return dip * rise * x * x / (1.0 + 0.9 * x * x);
}

// Columns of a line array's grid are joined to channels of about this sine, one degree.
constexpr double channel_sine = 0.018;

// Directions in a cone lie on rings, those of other views in rows of elevation. They are at most a
// quarter of a beam's width apart, for levels within 0.05 dB; with too many rings within 0.3 dB.
constexpr int min_rings = 128;
constexpr int max_rings = 1 << 14;
constexpr int ring_turns = 8;
constexpr double row_rad = radians(1.0);
constexpr double share_of_width = 0.25;
constexpr int min_steps = 16;
// The pattern of a side-scan sonar along the track is in row_power.
constexpr int rows_of_sides = 4;

int steps_over(double extent, double step) {
    return std::max(static_cast<int>(std::ceil(extent / step)), min_steps);
}

/// Rings of equal solid angle: the radius of the first is half the opening over their root.
int rings_of(const View& view, const BeamConfig& beam) {
    const double first_rad = share_of_width * radians(beam.width_deg);
    const double firsts = 0.5 * view.elevation_rad / first_rad;
    return static_cast<int>(std::clamp<double>(std::ceil(firsts * firsts), min_rings, max_rings));
}

/// The directions in which surface is traced, at most `step_rad` of azimuth apart.
EqualDirections traced_directions(const View& view, const BeamConfig& beam, double step_rad) {
    // Equal steps of the sine to the plane across an axis, and of the turn about that axis, have
    // equal solid angles. The axis is x in a cone, else z.
    const bool cone = view.shape == ViewShape::cone;
    const View wide = widened_view(view);
    const SinCos half = sincos(std::min(0.5 * wide.elevation_rad, 0.5 * pi));
    const double first = cone ? half.cos : -half.sin;
    const double last = cone ? 1.0 : half.sin;
    const double turn = cone ? 2.0 * pi : std::min(wide.azimuth_rad, 2.0 * pi);
    const double width_rad = radians(beam.elevation_width_deg);
    int rows =
        steps_over(wide.elevation_rad,
                   width_rad > 0.0 ? std::min(row_rad, share_of_width * width_rad) : row_rad);
    if (cone) rows = rings_of(view, beam);
    if (view.shape == ViewShape::port_starboard) rows = rows_of_sides;
    const int columns = cone ? ring_turns : steps_over(turn, step_rad);
    const GuardedField field(view);
    EqualDirections out{.all = {},
                        .each_sr = static_cast<float>((last - first) * turn / rows / columns)};
    for (int i = 0; i < rows; ++i) {
        const double sine = first + (last - first) * (i + 0.5) / rows;
        const double across = std::sqrt(1.0 - sine * sine);
        for (int j = 0; j < columns; ++j) {
            const SinCos at = sincos(turn * ((j + 0.5) / columns - 0.5));
            const Eigen::Vector3d direction =
                cone ? Eigen::Vector3d(sine, across * at.cos, across * at.sin)
                     : Eigen::Vector3d(across * at.cos, across * at.sin, sine);
            if (field.contains(direction.cast<float>())) out.all.push_back(direction.cast<float>());
        }
    }
    return out;
}

}  // namespace

WaterConfig water_of(const WaterConfig& water, const InstrumentConfig& instrument) {
    WaterConfig out = water;
    if (out.content == WaterContent::automatic) out.content = instrument.usual_water;
    return out;
}

double suspended_strength(double mg_per_l, double diameter_um, double wavenumber) {
    constexpr double quartz_kg_m3 = 2650.0;
    const double radius_m = 0.5e-6 * diameter_um;
    const double form = form_function(wavenumber * radius_m);
    const double kg_m3 = 1e-3 * mg_per_l;
    return 3.0 * kg_m3 * form * form / (16.0 * pi * quartz_kg_m3 * radius_m);
}

double volume_strength(const WaterConfig& water, double frequency_hz) {
    Content content = content_of(water.content);
    // A given level includes the suspended particles that are usual for `content`.
    if (water.scattering_db_per_m3) content = {power_of_db(*water.scattering_db_per_m3), 0.0};
    const double wavenumber = 2.0 * pi * frequency_hz / water.sound_speed_m_s;
    constexpr double grain_um = 50.0;  // diameter of silt
    return content.strength + suspended_strength(content.suspended_mg_l, grain_um, wavenumber);
}

std::optional<WaterColumn> water_column(const WaterConfig& water,
                                        const InstrumentConfig& instrument, const View& view,
                                        const Beams& beams, const SonarEquation& equation) {
    const double strength = volume_strength(water, instrument.frequency_hz);
    if (strength == 0.0 && water.layers.empty()) return std::nullopt;
    WaterColumn out;
    if (strength > 0.0)
        out.layers.push_back(
            {0.0F, std::numeric_limits<float>::infinity(), static_cast<float>(strength)});
    for (const WaterLayerConfig& layer : water.layers) {
        out.layers.push_back(
            {.top_m = static_cast<float>(layer.depth_m[0]),
             .bottom_m = static_cast<float>(layer.depth_m[1]),
             .strength = static_cast<float>(power_of_db(layer.scattering_db_per_m3))});
    }
    double step_rad = 0.5 * row_rad;
    if (instrument.beam.aperture == Aperture::head)
        step_rad = std::min(step_rad, share_of_width * radians(instrument.beam.width_deg));
    if (const SineGrid* const sines = beams.sines()) {
        out.joined_columns = std::max(static_cast<int>(channel_sine / sines->step), 1);
        step_rad = 0.5 * out.joined_columns * sines->step;
    }
    out.directions = traced_directions(view, instrument.beam, step_rad);
    const int padded = (equation.rows + lanes - 1) / lanes * lanes;
    out.row_power.resize(padded);
    for (int row = 0; row < equation.rows; ++row) {
        const double range_m = equation.range_min_m + (row + 0.5) * equation.bin_m;
        const double loss = equation.loss_per_m * range_m - equation.ln_headroom;
        const double power = equation.bin_m / (range_m * range_m) * exponential(-loss) *
                             beams.mean_along_track(view, range_m);
        out.row_power[row] = static_cast<float>(std::min<double>(power, max_echo));
    }
    return out;
}

}  // namespace sonarsim
