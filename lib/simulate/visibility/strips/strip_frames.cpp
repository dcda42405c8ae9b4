#include "core/elementary.h"
#include "simulate/visibility/strips/strip_triangles.h"

namespace sonarsim {

namespace {

// The picture plane stretches by 1 / cos^2 towards the edges of a sector.
constexpr double widest_sector = 2.1;  // rad

// A column of a side lies between two u, its beam between two elevations: at an azimuth a from the
// middle of a sector the two differ by a^2 / 2. With its mean, 0.3 % at the ends of a sector.
constexpr double widest_side = 0.2;  // rad

constexpr double widest_side_column = 0.035;  // sides, rad
constexpr int cone_columns = 32;

// The poles of a view lie at w = infinity. Surface within 5e-3 rad of them is ignored.
constexpr double steepest = 200.0;

double tangent(double angle) {
    const SinCos s = sincos(angle);
    return s.cos > 0.0 ? std::clamp(s.sin / s.cos, -steepest, steepest)
                       : std::copysign(steepest, s.sin);
}

int at_least_one(double width, double widest) {
    return std::max(1, static_cast<int>(std::ceil(width / widest - 1e-9)));
}

/// Completes a frame that has its axes, borders and beams.
void set_angles(double low, double high, double stretch, ColumnFrame& frame) {
    frame.angle_low = low;
    frame.angle_high = high;
    frame.stretch = stretch;
    frame.u_low = static_cast<float>(stretch * tangent(low));
    frame.u_high = static_cast<float>(stretch * tangent(high));
}

void set_border(ColumnFrame::Border border, double half_angle, ColumnFrame& frame) {
    frame.border = border;
    frame.tan_high = static_cast<float>(tangent(half_angle));
    frame.tan_low = -frame.tan_high;
}

/// Sectors of whole beams, or of parts of one beam.
void add_fan(const View& view, std::vector<ColumnFrame>& frames) {
    const int per_beam = at_least_one(view.azimuth_rad / view.beams, widest_column_rad);
    const int columns = view.beams * per_beam;
    const double width = view.azimuth_rad / columns;
    const int enough = at_least_one(view.azimuth_rad, widest_sector);
    const bool in_beams = view.beams < enough;
    const int sectors = in_beams ? view.beams * ((enough + view.beams - 1) / view.beams) : enough;
    const int whole = in_beams ? 1 : per_beam;
    const auto begin_of = [&](int s) {
        return whole * static_cast<int>(static_cast<long>(columns / whole) * s / sectors);
    };
    for (int s = 0; s < sectors; ++s) {
        const int first = begin_of(s);
        const int last = begin_of(s + 1);
        if (first == last) continue;
        const double half = 0.5 * (last - first) * width;
        const SinCos turn = sincos((0.5 * (first + last) - 0.5 * columns) * width);
        ColumnFrame frame;
        Eigen::Matrix3d R;
        R << turn.cos, turn.sin, 0.0, -turn.sin, turn.cos, 0.0, 0.0, 0.0, 1.0;
        frame.R_frame_sensor = R.cast<float>();
        set_border(ColumnFrame::Border::parallels, 0.5 * view.elevation_rad, frame);
        set_angles(-half, half, 1.0, frame);
        for (int k = first; k < last; ++k)
            frame.beams.push_back(k / per_beam);
        frames.push_back(frame);
    }
}

void add_side(const View& view, int side, std::vector<ColumnFrame>& frames) {
    const double extent = 0.5 * view.azimuth_rad;
    const int sectors = at_least_one(extent, widest_side);
    const double width = extent / sectors;
    const double mean_secant = 1.0 + width * width / 24.0;
    for (int s = 0; s < sectors; ++s) {
        const SinCos turn = sincos((side == 0 ? -extent : 0.0) + (s + 0.5) * width);
        ColumnFrame frame;
        Eigen::Matrix3d R;
        R << turn.cos, turn.sin, 0.0, 0.0, 0.0, 1.0, -turn.sin, turn.cos, 0.0;
        frame.R_frame_sensor = R.cast<float>();
        set_border(ColumnFrame::Border::straight, 0.5 * width, frame);
        set_angles(-0.5 * view.elevation_rad, 0.5 * view.elevation_rad, mean_secant, frame);
        frame.beams.assign(at_least_one(view.elevation_rad, widest_side_column), side);
        frames.push_back(frame);
    }
}

void add_cone(const View& view, std::vector<ColumnFrame>& frames) {
    ColumnFrame frame;
    frame.R_frame_sensor = Eigen::Matrix3f::Identity();
    set_border(ColumnFrame::Border::circle, 0.5 * view.azimuth_rad, frame);
    set_angles(-0.5 * view.azimuth_rad, 0.5 * view.azimuth_rad, 1.0, frame);
    frame.beams.assign(cone_columns, 0);
    frames.push_back(frame);
}

}  // namespace

std::vector<ColumnFrame> strip_frames(const View& view) {
    std::vector<ColumnFrame> frames;
    switch (view.shape) {
        case ViewShape::fan:
            add_fan(view, frames);
            break;
        case ViewShape::port_starboard:
            for (const int side : {0, 1})
                add_side(view, side, frames);
            break;
        case ViewShape::cone:
            add_cone(view, frames);
            break;
    }
    return frames;
}

std::vector<float> column_borders(const ColumnFrame& frame, int parts) {
    const int columns = parts * static_cast<int>(frame.beams.size());
    const double width = (frame.angle_high - frame.angle_low) / columns;
    std::vector<float> u{frame.u_low};
    for (int k = 1; k < columns; ++k)
        u.push_back(static_cast<float>(frame.stretch * tangent(frame.angle_low + k * width)));
    u.push_back(frame.u_high);
    return u;
}

}  // namespace sonarsim
