#pragma once

#include <optional>
#include <span>

#include "simulate/ping/sonar.h"
#include "simulate/product/bathymetry.h"

namespace sonarsim {

/// The swath of a side-scan ping on the ground, which is assumed level at the depth of the bottom's
/// first return.
struct Swath {
    Eigen::Vector2d nadir_m = Eigen::Vector2d::Zero();  ///< world x, y below the sonar
    Eigen::Vector2d port = Eigen::Vector2d::Zero();     ///< unit vector, world
    double altitude_m = 0.0;                            ///< altitude above the bottom
    double reach_m = 0.0;                               ///< ground range at range_max
};

/// The swath of a row of the waterfall. Nothing if the ping shows no bottom, or if the sonar's
/// sides point straight up and down.
std::optional<Swath> swath_of(const Sonar& sonar, const Pose& T_world_sensor,
                              std::span<const float> row);

/// Extends the bounds to both ends of the swath.
void add_bounds(const Swath& swath, SoundingBounds& bounds);

/// Adds a row of the waterfall to a map of echoes: a point at ground range g gets the echo at slant
/// range sqrt(g^2 + altitude^2). `map` holds the echo in place of z.
void rasterize(const Sonar& sonar, const Swath& swath, std::span<const float> row, Bathymetry& map);

}  // namespace sonarsim
