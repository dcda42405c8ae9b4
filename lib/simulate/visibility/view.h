#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sonarsim {

/// The division of a view into beams.
enum class ViewShape {
    fan,             ///< equal beams of azimuth; beam 0 is the most negative azimuth (starboard)
    port_starboard,  ///< beam 0 is starboard (azimuth < 0), beam 1 port (azimuth >= 0)
    cone             ///< one beam around the boresight
};

/// Beams on either side of a fan's view in which surface is traced as well, since the cones of a
/// line array's beams reach there.
struct GuardBeams {
    int count = 0;        ///< on either side
    double beam_rad = 0;  ///< width of each; 0: as wide as the beams of the view
    /// The number of neighbouring beams that are traced as one at error goals of 2 % and above: a
    /// divisor of the number of beams and, without `beam_rad`, of `count`.
    int joined = 1;

    bool operator==(const GuardBeams&) const = default;
};

/// The volume that a sonar views, in the sensor frame: x along the boresight, azimuth = atan2(y,
/// x), elevation = asin(z / r).
struct View {
    /// Full angle, centred on the boresight; for a cone its opening angle.
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;  ///< full angle; for a cone its opening angle
    double range_min_m = 0.0;
    double range_max_m = 0.0;
    int range_bins = 0;
    int beams = 0;
    double relative_l1 = 0.0;  ///< error goal of the noise-free image
    ViewShape shape = ViewShape::fan;
    bool energies_add = false;  ///< a bin holds the sum of its echoes, not their mean
    GuardBeams guards = {};     ///< the guard beams of the echo model; engines do not know of them

    bool operator==(const View&) const = default;

    double bin_m() const { return (range_max_m - range_min_m) / range_bins; }
};

/// True for a fan of all azimuths, whose last beam is next to its first.
bool is_full_turn(const View& view);

/// The width in which a view resolves directions, or an engine samples them.
double resolved_width_rad(const View& view);

/// The place in [0, beams) of one that is whole turns away from it.
inline float beam_in_turn(float beam, float beams) {
    const float in_turn = beam - beams * std::floor(beam / beams);
    return in_turn < beams ? in_turn : 0.0F;
}

/// The beam that contains a point of the sensor frame, or -1 outside the field of view. Intervals
/// are half-open in azimuth and elevation.
int beam_of(const View& view, const Eigen::Vector3f& point);

/// `beam_of` for many points: in float, and with the fraction of the beam. The two may differ for a
/// point within 2e-6 rad of an edge.
class BeamLocator {
  public:
    explicit BeamLocator(const View& view);

    /// Beam and its fraction, in [0, beams); -1 outside. `range_m` is the norm of `point`.
    float beam(const Eigen::Vector3f& point, float range_m) const;

    /// 0 for a cone, whose one beam surrounds the boresight.
    float beams_per_rad() const { return beams_per_rad_; }

  private:
    bool cone_;
    float beams_;
    float beams_per_rad_;
    float half_sine_;  ///< sine of half the elevation, or of half a cone's opening
};

}  // namespace sonarsim
