#pragma once

#include <vector>

#include "core/pose.h"
#include "scene/maps/ground_maps.h"
#include "trace/target_facet.h"
#include "visibility/view.h"

namespace sonarsim {

/// Gives the facets of targets the materials and strengths of the maps that lie on them. A facet on
/// which the maps change is cut until its parts are half a range bin deep and half a beam wide; a
/// part becomes one facet for each of its materials, with a strength in proportion to the
/// material's share.
void apply_maps_on_targets(const GroundMaps& maps, const View& view, const Pose& T_world_sensor,
                           std::vector<TargetFacet>& facets);

}  // namespace sonarsim
