#pragma once

#include <optional>
#include <span>

#include "ping/sonar.h"
#include "product/bathymetry.h"

namespace sonarsim {

/// Where the swath of a side-scan ping lies on the ground, which is taken to be level at the depth
/// of the bottom's first return.
struct Swath {
    Eigen::Vector2d nadir_m = Eigen::Vector2d::Zero();  ///< world x, y below the sonar
    Eigen::Vector2d port = Eigen::Vector2d::Zero();     ///< unit vector, world
    double altitude_m = 0.0;                            ///< over the bottom
    double reach_m = 0.0;                               ///< ground range at range_max
};

/// `row`: a row of the waterfall. Nothing where the ping shows no bottom, or where the sonar stands
/// on end, so that it has no side.
std::optional<Swath> swath_of(const Sonar& sonar, const Pose& T_world_sensor,
                              std::span<const float> row);

/// The ends of the swath.
void add_bounds(const Swath& swath, SoundingBounds& bounds);

/// Lays a row of the waterfall onto the ground: to a point at ground range g belongs the echo at
/// the slant range sqrt(g^2 + altitude^2). `map` then has the echo where a map of soundings has z.
void lay_down(const Swath& swath, double bin_m, std::span<const float> row, Bathymetry& map);

}  // namespace sonarsim
