#pragma once

#include <functional>
#include <vector>

#include "hard/cases.h"

namespace sonarsim {

// Helpers of the hard cases.

/// A small sonar of each kind, noise-free, with a gain of 1, from 0.2 to 10 m.
SonarConfig hard_sonar(SonarKind kind);
Sonar without_gain(const SonarConfig& config);

/// A change that a case makes to hard_sonar().
using ConfigChange = std::function<void(SonarConfig&)>;

/// True for a sonar whose default mount looks forward.
bool looks_forward(SonarKind kind);

/// A sonar three metres over z = 0; one that looks forward is pitched down by 30 degrees.
HardTrial over_floor(SonarKind kind, const ConfigChange& change = {});

/// A sonar in the tank of shapes.h.
HardTrial in_tank(SonarKind kind, const ConfigChange& change = {});
HardTrial plain_sonar_in_tank(SonarKind kind);

/// The tank at another position, with positions rounded to float about an origin on a grid of 10 m,
/// as when a file is read; and a sonar in it at the position of in_tank().
Scene moved_tank(const Eigen::Vector3d& by);
HardTrial in_moved_tank(SonarKind kind, const Eigen::Vector3d& by);

/// The tank in another size, and a sonar in it with its ranges scaled by the same factor.
Scene scaled_tank(double scale);
HardTrial in_scaled_tank(SonarKind kind, double scale);

/// UTM eastings and northings off the grid.
inline const Eigen::Vector3d utm_odd(512345.678, 4812345.678, -43.21);

/// A floor of 60 m at z = 0, R = 0.5.
Scene plain_floor();

/// The image of a plane at distance H: v . n = H / r, so R H / r in the middle of each bin with an
/// echo, to second order in bin / r. Not checked: dark pixels, and the first and the last filled
/// bin of a beam, which the plane fills in part.
std::vector<float> plane_law(const HardContext& context, double reflection, double height_m);

/// plane_law() at three metres over plain_floor().
std::vector<float> floor_law(const HardContext& context);

/// The brute-force reference after settling to 0.2 % or after two million rays.
std::vector<float> settled_reference(const HardContext& context);

std::vector<float> dark(const HardContext& context);

/// The image of any scene with an engine and an echo model, to compare others with.
std::vector<float> image_of(const Scene& scene, const HardTrial& trial, EngineKind engine,
                            ModelKind model = ModelKind::paper);

}  // namespace sonarsim
