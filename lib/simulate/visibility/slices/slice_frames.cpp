#include "simulate/visibility/slices/slice_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

// The picture plane stretches by 1 / cos^2 towards the edges of a sector.
constexpr double widest_sector = 2.1;  // rad

// A strip of a side has constant elevation; its slice is a great circle. At an azimuth d from the
// middle of a sector the two differ by d^2 / 2 of the elevation: 0.5 % at the ends of this one.
constexpr double widest_side = 0.2;  // rad

constexpr double widest_strip = 0.0088;      // fan, rad
constexpr double widest_side_strip = 0.035;  // port_starboard, rad
constexpr int cone_slices = 96;              // at one per beam

// The poles of a view lie at w = infinity, and so do the ends of a sector of 180 degrees. Surface
// within 1e-3 rad of the poles of elevation is ignored.
constexpr double steepest = 1e3;
constexpr double steepest_at_most = 1e5;

// The axis of a cone is a pole as well. Surface within this share of half the opening is ignored.
constexpr double ignored_at_axis = 1e-3;

double tangent(double angle, double steepest_slope = steepest) {
    const SinCos s = sincos(angle);
    return s.cos > 0.0 ? std::clamp(s.sin / s.cos, -steepest_slope, steepest_slope)
                       : std::copysign(steepest_slope, s.sin);
}

/// Offset of slice `k` from its place, in strips: small, and different for each slice, so that
/// slices do not run along edges that are parallel to the sonar's axes.
double aside(int k) {
    constexpr double golden = 0.6180339887498949;
    const double turns = golden * (k + 1);
    return 1e-3 * (0.5 + 0.5 * (turns - std::floor(turns)));
}

/// Equal strips of an angle across, numbered through all sectors.
struct Strips {
    double low;  ///< rad
    double width;
    int count;
    int per_beam;
    int first_beam;

    double at(double k) const { return low + k * width; }
    int beam(int k) const { return first_beam + k / per_beam; }
};

/// Adds the slices and beams of a sector that holds the strips [first, last) and whose middle is at
/// `centre`.
void add_slices(const Strips& strips, int first, int last, double centre, SliceFrame& frame) {
    const auto u = [&](double at) {
        return static_cast<float>(tangent(strips.at(at) - centre, steepest_at_most));
    };
    for (int k = first; k <= last; ++k)
        frame.slices.push_back(slice_at(frame, u(k + aside(k))));
    frame.slices_per_beam = strips.per_beam;
    frame.first_beam = strips.beam(first);
    for (int k = first; k < last; ++k) {
        if (k == first || strips.beam(k) != strips.beam(k - 1)) frame.beam_u.push_back(u(k));
    }
    frame.beam_u.push_back(u(last));
}

/// Frames whose axis along is the pole of the view: slices are meridians between two latitudes
/// with these tangents.
void add_meridians(const Strips& strips, const std::array<double, 2>& tangents,
                   const Eigen::Matrix3d& axes, std::vector<SliceFrame>& frames) {
    const int enough = std::max(
        1, static_cast<int>(std::ceil(strips.count * strips.width / widest_sector - 1e-9)));
    // A sector has whole beams, or lies in one beam.
    const int beams = strips.count / strips.per_beam;
    const int sectors = beams >= enough ? enough : beams * ((enough + beams - 1) / beams);
    const int whole = beams >= enough ? strips.per_beam : 1;
    const auto begin_of = [&](int s) -> int {
        return whole * static_cast<int>(static_cast<long>(strips.count / whole) * s / sectors);
    };
    for (int s = 0; s < sectors; ++s) {
        const int first = begin_of(s);
        const int last = begin_of(s + 1);
        if (first == last) continue;
        const double centre = strips.at(0.5 * (first + last));
        const SinCos turn = sincos(centre);
        SliceFrame frame;
        frame.meridians = true;
        frame.tan_low = static_cast<float>(tangents[0]);
        frame.tan_high = static_cast<float>(tangents[1]);
        Eigen::Matrix3d R;
        R.row(0) = turn.cos * axes.row(0) + turn.sin * axes.row(1);
        R.row(1) = turn.cos * axes.row(1) - turn.sin * axes.row(0);
        R.row(2) = axes.row(2);
        frame.R_frame_sensor = R.cast<float>();
        add_slices(strips, first, last, centre, frame);
        frame.w_low = frame.tan_low;
        frame.w_high = frame.tan_high;
        for (const Slice& slice : frame.slices) {
            frame.w_low = std::min(frame.w_low, slice.w_low);
            frame.w_high = std::max(frame.w_high, slice.w_high);
        }
        frames.push_back(frame);
    }
}

/// Frames whose slices run from `azimuth_low` to `azimuth_high`, one above the other.
void add_parallels(const Strips& strips, double azimuth_low, double azimuth_high,
                   std::vector<SliceFrame>& frames) {
    const int sectors =
        std::max(1, static_cast<int>(std::ceil((azimuth_high - azimuth_low) / widest_side - 1e-9)));
    const double width = (azimuth_high - azimuth_low) / sectors;
    for (int s = 0; s < sectors; ++s) {
        const SinCos turn = sincos(azimuth_low + (s + 0.5) * width);
        SliceFrame frame;
        frame.meridians = false;
        Eigen::Matrix3d R;
        R << turn.cos, turn.sin, 0.0, 0.0, 0.0, 1.0, -turn.sin, turn.cos, 0.0;
        frame.R_frame_sensor = R.cast<float>();
        frame.w_high = frame.tan_high = static_cast<float>(tangent(0.5 * width));
        frame.w_low = frame.tan_low = -frame.w_high;
        add_slices(strips, 0, strips.count, 0.0, frame);
        frames.push_back(frame);
    }
}

Strips strips_over(double low, double width, int beams, int per_beam, int first_beam = 0) {
    return {low, width / (static_cast<double>(beams) * per_beam), beams * per_beam, per_beam,
            first_beam};
}

}  // namespace

Slice slice_at(const SliceFrame& frame, float u) {
    if (!frame.meridians) return {u, frame.tan_low, frame.tan_high, 0.0F, 0.0F, true};
    // A parallel of the view is a hyperbola of the picture plane: w = tan(latitude) sqrt(1 + u^2).
    const float secant = std::sqrt(1.0F + u * u);
    return {u, frame.tan_low * secant, frame.tan_high * secant, frame.tan_low * u / secant,
            frame.tan_high * u / secant};
}

Interval w_over(const SliceFrame& frame, const Interval& u) {
    // The borders are straight, or bend one way on each side of u = 0.
    const Slice at[] = {slice_at(frame, u.from), slice_at(frame, u.to),
                        slice_at(frame, std::clamp(0.0F, u.from, u.to))};
    return {std::min({at[0].w_low, at[1].w_low, at[2].w_low}),
            std::max({at[0].w_high, at[1].w_high, at[2].w_high})};
}

std::vector<SliceFrame> slice_frames(const View& view, int per_beam) {
    std::vector<SliceFrame> frames;
    const double half_azimuth = 0.5 * view.azimuth_rad;
    const double half_elevation = 0.5 * view.elevation_rad;
    const auto enough = [&](double width, double widest) {
        return per_beam * std::max(1, static_cast<int>(std::ceil(width / widest - 1e-9)));
    };
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    switch (view.shape) {
        case ViewShape::fan:
            add_meridians(strips_over(-half_azimuth, view.azimuth_rad, view.beams,
                                      enough(view.azimuth_rad / view.beams, widest_strip)),
                          {tangent(-half_elevation), tangent(half_elevation)}, axes, frames);
            break;
        case ViewShape::port_starboard:
            for (const int side : {0, 1}) {
                const Strips strips =
                    strips_over(-half_elevation, view.elevation_rad, 1,
                                enough(view.elevation_rad, widest_side_strip), side);
                add_parallels(strips, side == 0 ? -half_azimuth : 0.0,
                              side == 0 ? 0.0 : half_azimuth, frames);
            }
            break;
        case ViewShape::cone:
            axes << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
            add_meridians(
                strips_over(-pi, 2.0 * pi, 1, cone_slices * per_beam),
                {tangent(0.5 * pi - half_azimuth, steepest_at_most),
                 std::clamp(1.0 / (ignored_at_axis * half_azimuth), steepest, steepest_at_most)},
                axes, frames);
            break;
    }
    return frames;
}

}  // namespace sonarsim
