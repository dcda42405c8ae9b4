#pragma once

#include <vector>

#include "core/pose.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The surface that a sonar sees.
struct VisibleSurface {
    Samples samples;  ///< within its view
    /// Within the guard beams, where the cones of a line array's beams reach.
    std::vector<Sample> outside_sector;
};

/// Beams on either side of a fan's view in which surface is traced as well.
struct GuardBeams {
    int count = 0;        ///< on either side
    double beam_rad = 0;  ///< width of each; 0: as wide as the beams of the view
    /// The number of neighbouring beams that are traced as one at error goals of 2 % and above: a
    /// divisor of the number of beams and, without `beam_rad`, of `count`.
    int joined = 1;
};

/// The view in which surface is traced: the sonar's view with guard beams on either side.
View widened_view(const View& view, const GuardBeams& guard_beams);
/// The widened view with the beams in which an engine traces it.
View traced_view(const View& view, const GuardBeams& guard_beams);

/// The field of view with its guard beams.
class GuardedField {
  public:
    /// `view` must outlive it.
    GuardedField(const View& view, const GuardBeams& guard_beams)
        : view_(view), guarded_(guard_beams.count > 0), field_(widened_view(view, guard_beams)) {}

    /// True if it contains a point of the sensor frame; in guard beams, if the cones of a fan's
    /// beams reach it.
    bool contains(const Eigen::Vector3f& point) const;

  private:
    const View& view_;
    bool guarded_;
    BeamLocator field_;
};

/// The views that visible_surface() traces.
std::vector<Sight> sights(const View& view, const GuardBeams& guard_beams,
                          const Pose& T_world_sensor);

/// True if the cones of a fan's beams reach a point in its guard beams: its y / r is no more than
/// that of the view's borders on the horizontal plane. `position` is in the sensor frame, m.
bool in_array_cones(const View& view, const Eigen::Vector3f& position);

/// The surface within the view, and in the guard beams the surface that the cones of its beams
/// reach. The first of several joined beams has the samples of all of them.
VisibleSurface visible_surface(const View& view, const GuardBeams& guard_beams,
                               const VisibilityEngine& engine, const Pose& T_world_sensor);

}  // namespace sonarsim
