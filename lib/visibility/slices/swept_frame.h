#pragma once

#include <cstddef>

#include "scene/scene.h"
#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_check.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/kept_gaps.h"

namespace sonarsim {

/// A ping that is to be swept and checked.
struct SlicesPing {
    const ClusterMesh& mesh;
    const Scene& scene;
    const View& view;  ///< as fine as the pass is to be
    LocalPose pose;
    bool any_error = false;  ///< the number of slices is fixed
};

/// The samples of checked beams.
struct CheckedBeams {
    std::vector<int> beams;  ///< in any order; several frames may share one
    Rows<Sample> samples;    ///< a row for each of them
};

/// True if several frames make the image of one beam together.
bool frames_share_beams(const View& view);

/// A frame whose slices were scanned. Beams that may have errors were kept and can be checked.
class SweptFrame {
  public:
    /// Adds the samples of the frame's beams to `samples`, and their image to `errors`. Samples of
    /// checks go to `checked`, which must outlive it, like the ping and the frame.
    SweptFrame(const SlicesPing& ping, const SliceFrame& frame, Samples& samples,
               BeamErrors& errors, CheckedBeams& checked);

    /// The beams that may have errors. If several frames share a beam, each has its part of it.
    const std::vector<KeptGaps::Beam>& uncertain() const { return kept_.beams; }

    /// The check of a beam, or of the frame's part of it.
    struct Check {
        int beam;         ///< its number in the view
        BeamSums& image;  ///< valid until the next check of the frame
    };

    /// Checks such a beam.
    Check check(std::size_t uncertain);

    /// Number of patches that were dropped so far.
    std::uint64_t dropped() const { return scan_.scene().dropped; }

  private:
    const SliceFrame& frame_;
    CheckedBeams& checked_;
    FrameScan scan_;
    AdaptiveSlices adaptive_;
    KeptGaps kept_;
    BeamCheck check_;
};

}  // namespace sonarsim
