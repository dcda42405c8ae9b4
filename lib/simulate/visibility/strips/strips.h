#pragma once

#include <cstddef>

#include "simulate/visibility/clusters_in_view.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// Goals of the error that are finer do not refine the strips any more.
inline constexpr double finest_goal = 0.003;

/// The visible surface of a view, where sound goes straight: cuts the triangles in view into the
/// columns of the view, a few for each beam, and finds what nearer pieces of its column leave of
/// each piece, on the line in the middle of it. `expected`: a number of samples for which room is
/// reserved; over a million triangles growing costs half the time.
Samples strips_surface(const ClustersInView& clusters, const View& view, std::size_t expected = 0);

}  // namespace sonarsim
