#pragma once

#include <string>
#include <vector>

#include "calibrate/bootstrap.h"
#include "recording/recording.h"

namespace sonarsim {

/// The soundings of a fan within a few degrees of incidence, port and starboard together.
struct SoundingsAtAngle {
    double angle_rad = 0.0;  ///< mean incidence on a flat bottom
    double range_m = 0.0;    ///< mean
    double level_db = 0.0;   ///< level of the mean power
    double spread_m = 0.0;   ///< standard deviation of the ranges about their neighbours'
    int count = 0;
};

inline constexpr double angle_step_deg = 4.0;

/// Soundings by angle. `slope_rad` turns the bottom about the track, positive down to port. The
/// spread is the standard deviation of second differences of the depth between neighbouring beams,
/// divided by sqrt(6), as a range: neither heave nor roll nor a plane slope changes it. Second
/// differences beyond 6 x 1.48 times their median size are outliers and do not count.
std::vector<SoundingsAtAngle> soundings_by_angle(const std::vector<RecordedSoundings>& pings,
                                                 const RecordedLaw& law, double slope_rad);

/// The parts of a level besides the strength of the bottom: the insonified area, which the beam or
/// the pulse limits, and the spreading that the gain leaves, (40 - tvg_log) log10 r.
struct SoundingsGeometry {
    double pulse_m = 0.0;    ///< length of the pulse in range
    double width_rad = 0.0;  ///< width of a beam across the track
    double tvg_log = 40.0;

    double gain_db(double angle_rad, double range_m) const;
};

/// The bottom and the fan, fitted to soundings.
struct SoundingsFit {
    SoundingsGeometry geometry;
    std::vector<double> angles_rad;
    std::vector<Bounded> strength_db;  ///< the bottom's, with source level and gain in it
    std::vector<Bounded> spread_m;     ///< spread of the ranges
    /// The strength as a law: Lambert's rule and the echo of facets, as in calibrated/bottom.h.
    Bounded lambert_db;     ///< with source level and gain in it
    Bounded facets_db;      ///< over Lambert's rule, at normal incidence
    Bounded slope_rms_deg;  ///< slope of the facets

    /// The number that the fit expects at an angle, by a line between the nearest two
    /// angles.
    double strength_db_at(double angle_rad) const;
    double spread_m_at(double angle_rad) const;
};

/// Fits soundings. InputError when fewer than six angles have a hundred soundings.
SoundingsFit fit_soundings(const std::vector<RecordedSoundings>& pings, const RecordedLaw& law,
                           double slope_rad, const SoundingsGeometry& geometry);

}  // namespace sonarsim
