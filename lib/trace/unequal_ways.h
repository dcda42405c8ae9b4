#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trace/counters.h"
#include "trace/multipath.h"
#include "trace/specular_path.h"
#include "trace/water_mirror.h"
#include "trace/way.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// A piece of surface that a way reaches, and an image of it that another way may reach.
struct CandidatePath {
    SpecularPath path;
    Eigen::Vector3f place;  ///< the piece itself, in the scene
    int reflections;        ///< on the other way
};

/// Adds the images of a piece over every proper subset of the reflectors of the way that met it, in
/// their order; the empty subset gives the piece itself. `seen` is the piece at its image over the
/// way. Images that find_bounces() has, and those outside the view, are left out.
void add_candidates(const TraceContext& trace, const BeamLocator& field, const Way& way,
                    const WayHit& at, const Sample& seen, std::vector<CandidatePath>& candidates);

/// Follows sound from the sonar to each image, and empties `candidates`. A path is added to
/// `arrived` if the sound meets the piece after exactly `reflections` reflections.
void trace_candidates(const Multipath& multipath, const TraceContext& trace,
                      const std::optional<WaterMirror>& water,
                      std::vector<CandidatePath>& candidates, std::vector<SpecularPath>& arrived,
                      MultipathCounts& counts);

}  // namespace sonarsim
