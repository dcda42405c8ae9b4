#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

#include "simulate/water/sound_profile.h"

namespace sonarsim {

/// The state of a ray of sound at one point of its path, in its vertical plane. Between two nodes
/// of a profile the path is an arc of the radius c / (g cos(elevation)).
struct WaterRay {
    double along_m = 0.0;        ///< horizontal distance
    double height_m = 0.0;       ///< world
    double elevation_rad = 0.0;  ///< above the horizontal
    double time_s = 0.0;
    /// Distance across the ray to a neighbour, over their difference in elevation at the start.
    /// With one speed of sound it equals the length of the ray. Its sign changes at a caustic.
    double tube_m = 0.0;
    double tube_per_m_s = 0.0;  ///< its growth with the integral of the speed along the ray
    std::size_t layer = 0;
};

/// A ray at its start.
WaterRay water_ray(const SoundProfile& profile, double height_m, double elevation_rad);

/// The ray `length_m` further on the arc of its layer.
WaterRay on_arc(const SoundProfile& profile, const WaterRay& ray, double length_m);

/// The length of an arc whose chord is `sag_m` off at most.
double length_with_sag(const SoundProfile& profile, const WaterRay& ray, double sag_m);

/// Moves a ray on to the end of its layer, by `longest_m` at most. Returns the length.
double advance(const SoundProfile& profile, double longest_m, WaterRay& ray);

/// The true place of an echo that an instrument at `source` receives from the unit direction
/// `direction` at the measured range `range_m`. World.
Eigen::Vector3d place_of(const SoundProfile& profile, const Eigen::Vector3d& source,
                         const Eigen::Vector3d& direction, double range_m);

/// The least width of a tube of rays, as a share of its width where sound goes straight: a two-way
/// gain of 20 dB at most. Chosen: rays lack the diffraction that limits a caustic.
inline constexpr double min_spread = 0.1;

/// The surroundings of a true place as an instrument receives them: x - place becomes
/// R (x - place) + apparent, relative to the source. World.
struct ApparentPlace {
    Eigen::Vector3d place, apparent;
    Eigen::Quaterniond R;
    double strength;  ///< factor on the power of an echo, as sound converges or spreads
    /// The error of a place for each metre from `place`, as R does not stretch.
    double off_per_m;
};

/// The inverse of place_of(); nothing if no ray that departs near the line of sight leads there.
std::optional<ApparentPlace> apparent_place(const SoundProfile& profile,
                                            const Eigen::Vector3d& source,
                                            const Eigen::Vector3d& place);

}  // namespace sonarsim
