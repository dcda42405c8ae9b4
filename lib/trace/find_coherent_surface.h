#pragma once

#include "core/pose.h"
#include "scene/scene.h"
#include "trace/coherent_faces.h"
#include "trace/coherent_surface.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// The coherent surface within the range of a view. Rays test its visibility: for a plate, one to
/// the foot of the perpendicular and eight to every edge. A strip has 8 to 64 parts and a seam 16
/// parts; each part has one ray to each face that the sound meets.
CoherentSurface find_coherent_surface(const CoherentFaces& faces, const Scene& scene,
                                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                                      const View& view);

}  // namespace sonarsim
