#pragma once

#include "core/pose.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The view in which surface is traced: the sonar's view with guard beams on either side.
View widened_view(const View& view);
/// The widened view with the beams in which an engine traces it.
View traced_view(const View& view);

/// The field of view with its guard beams.
class GuardedField {
  public:
    /// `view` must outlive it.
    explicit GuardedField(const View& view) : view_(view), field_(widened_view(view)) {}

    /// True if it has a point of the sensor frame; in guard beams, if a fan's cones reach it.
    bool contains(const Eigen::Vector3f& point) const;

  private:
    const View& view_;
    BeamLocator field_;
};

/// The views that visible_surface() traces.
std::vector<Sight> sights(const View& view, const Pose& T_world_sensor);

/// True if the cones of a fan's beams reach a point in its guard beams: its y / r is no more than
/// that of the view's borders on the horizontal plane. `position` is in the sensor frame, m.
bool in_array_cones(const View& view, const Eigen::Vector3f& position);

/// The surface within the view and, in no beam, that in the guard beams which the cones of the
/// view's beams reach. The first of several joined beams has the samples of all of them.
Samples visible_surface(const View& view, const VisibilityEngine& engine,
                        const Pose& T_world_sensor);

}  // namespace sonarsim
