#pragma once

#include <vector>

#include "visibility/slices/clusters.h"
#include "visibility/slices/envelope.h"

namespace sonarsim {

/// Whether two facets of the scene, at `range_m`, lie on one plane, of one material and instance.
bool one_plane(const ClusterMesh& mesh, const SliceScene& scene, std::uint32_t a, std::uint32_t b,
               float range_m);

/// Makes one of neighbouring spans that lie on one plane, of one material and instance: a flat wall
/// is one span, whatever it is cut into.
void merge_coplanar_spans(const ClusterMesh& mesh, const SliceScene& scene,
                          std::vector<VisibleSpan>& spans);

}  // namespace sonarsim
