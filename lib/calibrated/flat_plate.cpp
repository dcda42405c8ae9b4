#include "calibrated/flat_plate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// Within a piece of an edge the phase departs from a straight line by at most this.
constexpr double max_bend_rad = 0.1;
// A piece turns by at most this about the foot of the perpendicular.
constexpr double max_turn_rad = 0.1;
constexpr int most_pieces = 100'000;
// 2 k s^2 / r beyond which an edge is not integrated in pieces: the relative error is its inverse.
constexpr double many_turns_rad = 200.0;

std::complex<double> turned(double radians) {
    const SinCos turn = sincos(radians);
    return {turn.cos, turn.sin};
}

/// The plate as its sonar sees it.
struct Geometry {
    Eigen::Vector3d foot;  ///< the foot of the perpendicular
    Eigen::Vector3d normal;
    double height_m;
    double k;  ///< wave number
    double amplitude;
    double roughness_m;

    /// V / (4 pi) H / r^2, with the loss of a rough surface.
    double weight(double range_m) const {
        const double loss = k * roughness_m * height_m / range_m;
        return amplitude / (4.0 * pi) * height_m / (range_m * range_m) *
               exponential(-2.0 * loss * loss);
    }
};

/// The length of a piece of an edge. The piece begins at the distance `s` from the line's point
/// nearest to the foot, which is at the distance `d` from the foot.
double piece_length(const Geometry& of, const EdgeLimits& limits, double s, double d) {
    const double flat2 = s * s + d * d;
    const double range = std::sqrt(of.height_m * of.height_m + flat2);
    // The phase 2 k r bends by 2 k (H^2 + d^2) / r^3 at most.
    double length = std::sqrt(8.0 * max_bend_rad * range / (2.0 * of.k));
    if (d != 0.0) length = std::min(length, max_turn_rad * flat2 / std::fabs(d));
    // The angle turns fastest at s = 0, so pieces get shorter towards it.
    if (s < 0.0) length = std::min(length, std::max(-0.3 * s, max_turn_rad * std::fabs(d)));
    if (limits.sine > 0.0) length = std::min(length, limits.sine * range);
    if (limits.depth_m > 0.0)
        length = std::min(length, limits.depth_m * range / (std::fabs(s) + limits.depth_m));
    return length;
}

/// An edge along its line. s is the distance from the line's point nearest to the foot.
struct EdgeLine {
    const Geometry& of;
    Eigen::Vector3d next;  ///< that point
    Eigen::Vector3d unit;
    double d;  ///< its distance from the foot, positive if the edge winds around it

    double range(double s) const { return std::sqrt(of.height_m * of.height_m + d * d + s * s); }

    /// The angle about the foot from one place to another.
    double angle(double from, double to) const {
        return arctan2(d * (to - from), d * d + from * to);
    }
    PlateEcho echo(double s, std::complex<double> amplitude) const {
        return {next + s * unit, range(s), amplitude};
    }
};

/// Adds the integral over a stretch of an edge, piece by piece.
void add_pieces(const EdgeLine& line, double begin, double end, const EdgeLimits& limits,
                std::vector<PlateEcho>& echoes) {
    const Geometry& of = line.of;
    const double least = (end - begin) / most_pieces;
    double s = begin;
    double range = line.range(s);
    while (s < end) {
        const double step = std::max(least, piece_length(of, limits, s, line.d));
        const double next = end - s < 1.5 * step ? end : s + step;
        const double next_range = line.range(next);
        const double middle = 0.5 * (s + next);
        const double middle_range = line.range(middle);
        // The phase is linear over the piece, about its mean by Simpson's rule.
        const double half_turn = of.k * (next_range - range);
        const double fades = sinc(half_turn / pi);
        echoes.push_back(
            line.echo(middle, of.weight(middle_range) * line.angle(s, next) * fades *
                                  turned(of.k * (range + 4.0 * middle_range + next_range) / 3.0)));
        s = next;
        range = next_range;
    }
}

/// Adds the integral over a stretch of an edge without a stationary phase: the integral of g(s)
/// exp(i f) is the difference of g exp(i f) / (i f') at its ends, f = 2 k r, g = weight d / (d^2 +
/// s^2).
void add_ends(const EdgeLine& line, double begin, double end, std::vector<PlateEcho>& echoes) {
    if (!(end > begin)) return;
    for (const double s : {begin, end}) {
        const double range = line.range(s);
        const double slope = 2.0 * line.of.k * s / range;
        const double g = line.of.weight(range) * line.d / (line.d * line.d + s * s);
        const std::complex<double> phase = turned(2.0 * line.of.k * range);
        const double size = (s == end ? 1.0 : -1.0) * g / slope;
        echoes.push_back(line.echo(s, size * phase * std::complex<double>(0.0, -1.0)));
    }
}

/// Adds the echoes of an edge. Returns the angle that it subtends at the foot.
double add_edge(const Geometry& of, const PlateEdge& edge, const EdgeLimits& limits,
                std::vector<PlateEcho>& echoes) {
    const Eigen::Vector3d along = edge.to - edge.from;
    const double edge_m = along.norm();
    if (!(edge_m > 0.0)) return 0.0;
    const Eigen::Vector3d unit = along / edge_m;
    const Eigen::Vector3d from_foot = edge.from - of.foot;
    const double begin = from_foot.dot(unit);
    const double end = begin + edge_m;
    const EdgeLine line{of, edge.from - begin * unit, unit, of.normal.dot(from_foot.cross(unit))};
    if (edge.seen) {
        // Further out the phase is nearly linear over many turns.
        const double even = std::sqrt(many_turns_rad * line.range(0.0) / (2.0 * of.k));
        add_ends(line, begin, std::min(end, -even), echoes);
        add_pieces(line, std::max(begin, -even), std::min(end, even), limits, echoes);
        add_ends(line, std::max(begin, even), end, echoes);
    }
    return line.angle(begin, end);
}

}  // namespace

void add_plate_echoes(const PlateOfPing& plate, const PlateSurface& surface, double wavelength_m,
                      const EdgeLimits& limits, std::vector<PlateEcho>& echoes) {
    double area = 0.0;  // positive if the edges are counter-clockwise about the normal
    for (const PlateEdge& edge : plate.edges)
        area += 0.5 * plate.normal.dot(edge.from.cross(edge.to));
    const Geometry geometry{.foot = plate.height_m * plate.normal,
                            .normal = plate.normal,
                            .height_m = plate.height_m,
                            .k = 2.0 * pi / wavelength_m,
                            .amplitude = std::copysign(std::sqrt(surface.reflection), area),
                            .roughness_m = surface.roughness_m};
    double angle = 0.0;
    for (const PlateEdge& edge : plate.edges)
        angle += add_edge(geometry, edge, limits, echoes);
    // The angle is zero if the foot is outside the plate.
    if (plate.foot_seen && std::fabs(angle) > 1e-9) {
        echoes.push_back(
            {geometry.foot, plate.height_m,
             -geometry.weight(plate.height_m) * angle * turned(2.0 * geometry.k * plate.height_m)});
    }
}

}  // namespace sonarsim
