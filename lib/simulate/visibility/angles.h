#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/elementary.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

inline SinCosFloat sincos_float(double angle) {
    const SinCos s = sincos(angle);
    return {static_cast<float>(s.sin), static_cast<float>(s.cos)};
}

/// Sine and cosine of the sum of two angles, and of their difference.
inline SinCosFloat operator+(SinCosFloat a, SinCosFloat b) {
    return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin};
}

inline SinCosFloat operator-(SinCosFloat a, SinCosFloat b) {
    return a + SinCosFloat{-b.sin, b.cos};
}

/// Unit vector in the sensor frame, radians.
inline Eigen::Vector3d direction_of(double azimuth_rad, double elevation_rad) {
    const SinCos a = sincos(azimuth_rad);
    const SinCos e = sincos(elevation_rad);
    return {e.cos * a.cos, e.cos * a.sin, e.sin};
}

/// The unit vector at the angle `off_rad` from the boresight, and `around_rad` about it from y
/// towards z.
inline Eigen::Vector3d direction_off_boresight(double off_rad, double around_rad) {
    const SinCos off = sincos(off_rad);
    const SinCos around = sincos(around_rad);
    return {off.cos, off.sin * around.cos, off.sin * around.sin};
}

// A view is swept by two angles: `across` numbers its columns, `along` runs through each of them.
//   fan:   across is azimuth, along is elevation: a column lies within a beam;
//   port_starboard: across is elevation, along is azimuth, from nadir outward on either side;
//   cone:  across is tau, the angle around the boresight, along is psi, the angle off it.

/// The direction as a unit vector in the sensor frame.
inline Eigen::Vector3f direction(ViewShape shape, SinCosFloat across, SinCosFloat along) {
    switch (shape) {
        case ViewShape::port_starboard:
            return {across.cos * along.cos, across.cos * along.sin, across.sin};
        case ViewShape::cone:
            return {along.cos, along.sin * across.cos, along.sin * across.sin};
        default:
            return {along.cos * across.cos, along.cos * across.sin, along.sin};
    }
}

/// A strip of a view that lies within one beam: angles [across - width / 2, across + width / 2] by
/// [along_min, along_max].
struct ViewColumn {
    int beam;
    double across;  ///< middle angle, rad
    double width;   ///< rad
    double along_min;
    double along_max;
};

/// Divides the view into columns of equal width, sorted by beam: `per_beam` columns in each beam of
/// a fan, `per_beam` on each side, or `per_beam` sectors of a cone.
std::vector<ViewColumn> view_columns(const View& view, int per_beam);

}  // namespace sonarsim
