#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "trace/coherent_surface.h"

namespace sonarsim {

/// The surface of a plate.
struct PlateSurface {
    double reflection = 1.0;  ///< power reflection coefficient at normal incidence
    double roughness_m = 0.0;
};

/// The greatest length of a piece of an edge, in range and in the sine of an angle.
struct EdgeLimits {
    double depth_m = 0.0;
    double sine = 0.0;
};

/// A part of a plate's echo: the specular point, or a piece of an edge.
struct PlateEcho {
    Eigen::Vector3d point;           ///< sensor frame, m
    double range_m;                  ///< range of the point
    std::complex<double> amplitude;  ///< at the sonar, over that of the source at 1 m
};

/// The coherent echo of a plate from a point source and receiver, without absorption, appended to
/// `echoes`. The plate's echo is the sum of their amplitudes. Edges wind around the plate in one
/// sense and around its holes in the other. Hidden edges add no echo.
///
/// The Kirchhoff integral over the plate, at kr >> 1, H being the sonar's height over its plane, is
///
///     p = i V / lambda  integral of (H / r^3) exp(2 i k r) dA,    dA = r dr dphi,
///
/// phi being the azimuth about the foot of the perpendicular. The integral over r is that of
/// exp(2 i k r) / r^2, about exp(2 i k r) / (2 i k r^2). An integral over the boundary is left:
///
///     p = V H / (4 pi) (integral of exp(2 i k r) / r^2 dphi - exp(2 i k H) / H^2 integral of dphi)
///
/// The second integral is 2 pi where the foot is on the plate, else 0: an infinite plate gives the
/// image source, V / (2 H). V is the root of the reflection coefficient times the loss of a rough
/// surface, exp(-2 (k h H / r)^2) (Eckart 1953), which is exp(-(2 k h sin)^2) in power. Literature:
/// e.g. Medwin and Clay, "Fundamentals of Acoustical Oceanography" (1998), chapter 11.
void add_plate_echoes(const PlateOfPing& plate, const PlateSurface& surface, double wavelength_m,
                      const EdgeLimits& limits, std::vector<PlateEcho>& echoes);

}  // namespace sonarsim
