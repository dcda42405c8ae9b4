#pragma once

#include <functional>
#include <vector>

#include "validation/hard/cases.h"
#include "validation/reference.h"

namespace sonarsim {

// What the hard cases share.

/// A small sonar of each kind, noise-free, its gain 1, 0.2 to 10 m.
SonarConfig hard_sonar(SonarKind kind);
Sonar without_gain(const SonarConfig& config);

/// What a case changes in the sonar that all cases share.
using ConfigChange = std::function<void(SonarConfig&)>;

/// Three metres over z = 0; an imaging sonar pitched down by 30 degrees.
HardTrial over_floor(SonarKind kind, const ConfigChange& change = {});
HardTrial plain_sonar_over_floor(SonarKind kind);

/// In the tank of shapes.h.
HardTrial in_tank(SonarKind kind, const ConfigChange& change = {});
HardTrial plain_sonar_in_tank(SonarKind kind);

/// The tank somewhere else, as a file that says so would be read: positions are rounded to float
/// about an origin on a grid of 10 m; and a sonar in it, where in_tank has it.
Scene moved_tank(const Eigen::Vector3d& by);
HardTrial in_moved_tank(SonarKind kind, const Eigen::Vector3d& by, const ConfigChange& change = {});

/// The tank in another size, and a sonar in it that sees as far in proportion.
Scene scaled_tank(double scale);
HardTrial in_scaled_tank(SonarKind kind, double scale, const ConfigChange& change = {});

/// Eastings and northings as in UTM, off the grid.
inline const Eigen::Vector3d utm_odd(512345.678, 4812345.678, -43.21);

/// A floor of 60 m at z = 0, R = 0.5.
Scene plain_floor();

/// Of a plane at distance H, v . n = H / r wherever it is seen: R H / r in the middle of each bin
/// that sees it, to the second order of bin / r. Unchecked are dark pixels, and the first and the
/// last lit bin of a beam, which the plane fills in part.
std::vector<float> plane_law(const HardContext& context, double reflection, double height_m);

/// That law three metres over plain_floor().
std::vector<float> floor_law(const HardContext& context);

/// The brute-force reference of this very scene.
std::vector<float> reference_of(const HardContext& context, const ReferenceGoal& goal);

/// The same, settled to 0.2 % or after two million rays.
std::vector<float> settled_reference(const HardContext& context);

std::vector<float> dark(const HardContext& context);

/// What the same engine shows of another scene.
std::vector<float> image_of(const Scene& scene, const HardTrial& trial, EngineKind engine);

}  // namespace sonarsim
