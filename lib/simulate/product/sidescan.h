#pragma once

#include <optional>
#include <span>

#include "simulate/ping/sonar.h"
#include "simulate/product/bathymetry.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

// A row of a side-scan waterfall runs from port at range_max over nadir to starboard at range_max,
// in columns as wide as a range bin. It has blank columns between nadir and range_min, where the
// sonar does not listen, so that slant range is linear in the column on both sides.

struct Side {
    static constexpr int starboard = 0, port = 1;
};

/// The number of columns between nadir and range_min on each side: range_min in bins, rounded.
int blank_columns(const SonarConfig& config);

/// The slant range of a column less its distance from nadir: at most half a bin to either side.
double column_offset_m(const SonarConfig& config);

int waterfall_columns(const SonarConfig& config);

/// The bin of Ping::intensity, [range bins, 2], in each column; -1 where the sonar does not listen.
std::vector<std::int32_t> waterfall_bins(const SonarConfig& config);

/// The slant range from which on a beam receives the visible bottom, m; or beyond range_max.
std::optional<double> first_return_m(const Samples& samples,
                                     std::span<const std::uint8_t> is_bottom, const View& view,
                                     int beam);

/// The swath of a side-scan ping: the line in which its plane, across the bow, meets level ground.
struct Swath {
    Eigen::Vector2d nadir_m = Eigen::Vector2d::Zero();  ///< world x, y nearest on the line
    Eigen::Vector2d port = Eigen::Vector2d::Zero();     ///< unit vector along it, world
    double distance_m = 0.0;                            ///< from the sonar to the line
    double altitude_m = 0.0;                            ///< altitude above the bottom
    double reach_m = 0.0;                               ///< ground range at range_max
};

/// The swath of a ping at an altitude; nothing without a bottom, or with the bow up or down.
std::optional<Swath> swath_of(const Sonar& sonar, const Pose& T_world_sensor,
                              std::optional<double> altitude_m);

void add_bounds(const Swath& swath, GroundBounds& bounds);

struct SwathRow {
    Swath swath;
    std::vector<float> values;
};

/// Adds the ground between two rows that follow each other, in steps of half a bin across and a
/// quarter of a cell along, over which the echo changes linearly. A point at ground range g has the
/// echo at slant range sqrt(g^2 + distance^2). At the share u of the reach it weighs 4 u (1 - u)
/// times the ground that it stands for: least at nadir, where the bottom is bright, and at the
/// swath's end, so that no line begins at a seam. Rows whose headings differ by 10 degrees, or that
/// are ten cells apart, have no ground between them; the later one is added alone.
void add_between(const Sonar& sonar, const SwathRow& before, const SwathRow& row,
                 GroundGrid& mosaic);

}  // namespace sonarsim
