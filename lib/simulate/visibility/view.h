#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "core/pose.h"

namespace sonarsim {

/// The division of a view into beams.
enum class ViewShape {
    fan,             ///< equal beams of azimuth; beam 0 is the most negative azimuth (starboard)
    port_starboard,  ///< beam 0 is starboard (azimuth < 0), beam 1 port (azimuth >= 0)
    cone             ///< one beam around the boresight
};

// Beams of a fan that are wider are cut into columns of strips; fitted to measured errors.
constexpr double widest_column_rad = 0.0096;

/// Beams beside a fan's view in which surface is traced as well: a line array's cones reach there.
struct GuardBeams {
    int count = 0;        ///< on either side
    double beam_rad = 0;  ///< width of each; 0: as wide as the beams of the view
    /// The number of neighbouring beams that are traced as one at error goals of 2 % and above: a
    /// divisor of the number of beams and, without `beam_rad`, of `count`.
    int joined = 1;

    bool operator==(const GuardBeams&) const = default;
};

/// The volume in view: x along the boresight, azimuth = atan2(y, x), elevation = asin(z / r).
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

/// The beam that contains a point of the sensor frame; -1 outside the view. Half-open intervals.
int beam_of(const View& view, const Eigen::Vector3f& point);

/// `beam_of` for many points: in float, with the fraction. It may differ within 2e-6 rad of edges.
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

/// A sensor pose relative to the scene's local origin.
struct LocalPose {
    Eigen::Matrix3f rotation;  ///< R_local_sensor
    Eigen::Vector3f position;  ///< m
};

inline LocalPose local_pose(const Pose& T_world_sensor, const Eigen::Vector3d& scene_origin) {
    return {T_world_sensor.rotation.toRotationMatrix().cast<float>(),
            (T_world_sensor.translation - scene_origin).cast<float>()};
}

enum class Containment { outside, partly, inside };

/// The volume that a ping views. Points are given in local axes relative to the sensor.
class ViewVolume {
  public:
    ViewVolume(const View& view, const Pose& T_local_sensor);

    /// Position of the ball relative to the volume. `outside` and `inside` are certain.
    Containment containment(const Eigen::Vector3f& centre, float radius) const {
        return contains_in_sensor_frame(R_sensor_local_ * centre, radius);
    }

    /// The same for a cube, by the ball around it: more than half its diagonal, for rounding.
    Containment contains_cube(const Eigen::Vector3f& centre, float edge) const {
        return containment(centre, 0.8661F * edge + rounding_m());
    }

    /// The same with `centre` in the sensor frame.
    Containment contains_in_sensor_frame(const Eigen::Vector3f& centre, float radius) const;

    /// More than the error of a position within the range: four roundings of 6e-8 of the range.
    float rounding_m() const { return 1e-6F * reach_m_; }

    const Eigen::Vector3d& position() const { return position_; }
    const Eigen::Matrix3f& R_sensor_local() const { return R_sensor_local_; }

  private:
    Eigen::Matrix3f R_sensor_local_;
    Eigen::Vector3d position_;  ///< position of the sensor, scene-local
    float reach_m_;
    float sin_azimuth_, cos_azimuth_;  ///< half the opening angle; the same for elevation
    float sin_elevation_, cos_elevation_;
};

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

/// The unit vector `off_rad` from the boresight, and `around_rad` about it from y towards z.
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

/// A strip of a view in a beam: angles [across -+ width / 2] by [along_min, along_max].
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
