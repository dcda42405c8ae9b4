#pragma once

#include <vector>

#include "visibility/slices/clusters.h"
#include "visibility/slices/envelope.h"

namespace sonarsim {

/// True if two facets of the scene, at `range_m`, lie in one plane and have one material and
/// instance.
bool one_plane(const ClusterMesh& mesh, const SliceScene& scene, std::uint32_t a, std::uint32_t b,
               float range_m);

/// Merges neighbouring spans in one plane with one material and instance: a flat wall is one span,
/// however it is divided into triangles.
void merge_coplanar_spans(const ClusterMesh& mesh, const SliceScene& scene,
                          std::vector<VisibleSpan>& spans);

}  // namespace sonarsim
