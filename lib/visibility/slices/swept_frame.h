#pragma once

#include <cstddef>
#include <span>
#include <vector>

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
    const View& view;  ///< with the error goal of the pass
    LocalPose pose;
    bool any_error = false;  ///< the number of slices is fixed
};

/// The image of a ping by its slices, and by its checks.
struct SlicesImage {
    explicit SlicesImage(const View& view);

    Samples samples;
    BeamErrors errors;
    std::vector<int> checked;      ///< beams in any order; several frames may share one
    Rows<Sample> checked_samples;  ///< a row for each of them
};

/// True if several frames make the image of one beam together.
bool frames_share_beams(const View& view);

/// Scans the slices of a view's frames, and checks all beams that may have errors.
void sweep_and_check(const SlicesPing& ping, std::span<const SliceFrame> frames,
                     SlicesImage& image);

/// A frame whose slices were scanned. Beams that may have errors were kept and can be checked.
class SweptFrame {
  public:
    /// Adds the frame's beams to the image, which must outlive it, like the ping and the frame. No
    /// other frame shares its beams.
    SweptFrame(const SlicesPing& ping, const SliceFrame& frame, SlicesImage& image);

    /// The beams that may have errors.
    const std::vector<KeptGaps::Beam>& uncertain() const { return kept_.beams; }

    /// Checks beam uncertain()[`uncertain`], which stands for `weight` beams. Call it after
    /// BeamErrors::finish().
    void check(std::size_t uncertain, double weight);

    /// Number of patches that were dropped so far.
    std::uint64_t dropped() const { return scan_.scene().dropped; }

  private:
    const SliceFrame& frame_;
    SlicesImage& image_;
    FrameScan scan_;
    AdaptiveSlices adaptive_;
    KeptGaps kept_;
    BeamCheck check_;
};

}  // namespace sonarsim
