#pragma once

#include <vector>

#include "visibility/slices/clusters.h"
#include "visibility/slices/envelope.h"

namespace sonarsim {

/// Whether two spans lie on one plane, of one material and instance.
bool one_plane(const ClusterMesh& mesh, const SliceScene& scene, const VisibleSpan& a,
               const VisibleSpan& b);

/// Makes one of neighbouring spans that lie on one plane, of one material and instance: a flat wall
/// is one span, whatever it is cut into.
void merge_coplanar_spans(const ClusterMesh& mesh, const SliceScene& scene,
                          std::vector<VisibleSpan>& spans);

}  // namespace sonarsim
