#include "visibility/slices/slices_engine.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/slices/agreeing_slices.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/sliver_bins.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

namespace {

// With a number of slices that is given, gaps are split for narrow pieces alone.
constexpr DisagreementLimit unlimited{.share = 1e9, .lent = 0.0};

/// Slices to a beam that an error goal begins with.
int slices_for(double relative_l1) {
    return is_coarse(relative_l1) ? 1 : relative_l1 >= 0.005 ? 2 : 4;
}

// How far the slices of an image disagree says how far the image is off. Fitted to the errors of a
// lifeboat of 7,920 triangles and a tank, eight poses each at goals of 10, 3, 1 and 0.3 %, within a
// factor of 1.7. The square root: where slices are added they are added where they disagree most,
// and the rest of the error does not fall along with it.
constexpr double error_of_disagreement = 0.16;

/// Error of an image whose slices see everything: pieces of surface become boxes in range.
double error_of_shapes(double relative_l1) {
    return 0.002 + 0.003 * std::clamp(relative_l1 / 0.03, 0.1, 1.0);
}

double estimated_error(double relative_l1, double disagreement) {
    return error_of_shapes(relative_l1) + error_of_disagreement * std::sqrt(disagreement);
}

/// What slices may disagree by for an error goal, of which slivers take `slivers`. Goals near the
/// error of shapes are not met by more slices: they end at an eighth of the goal.
DisagreementLimit disagreement_for(double relative_l1, double slivers) {
    // A coarse goal is used up but for a tenth, by which the estimate may be off: beams lend to
    // each other, and slivers are made up for. At 1 % errors come out up to 1.15 times the
    // estimate, and every beam has to keep within the goal by itself.
    const bool coarse = is_coarse(relative_l1);
    const double goal = coarse ? 0.9 * relative_l1 - slivers : relative_l1;
    const double left = std::max(goal - error_of_shapes(relative_l1), 0.0);
    return {.share = std::max(left * left / (error_of_disagreement * error_of_disagreement),
                              0.125 * relative_l1),
            .lent = coarse ? 0.25 : 0.0};
}

/// Cuts the strips that slices stand for where a beam ends.
class BeamCutter {
  public:
    /// All arguments must outlive it.
    BeamCutter(const SliceFrame& frame, StripQuads& quads, SliverBins& slivers, Samples& samples)
        : frame_(frame), quads_(quads), slivers_(slivers), samples_(samples) {
        slivers_.begin_beam(frame_.first_beam);
    }

    /// Adds the samples of a strip. Strips are to be added from low u to high, without gaps.
    void add(const SeenSlice& seen) {
        if (beam_ + 1 == static_cast<int>(frame_.beam_u.size())) return;  // no width is left
        const MovedEnds* low = &seen.low;
        while (frame_.beam_u[beam_ + 1] < seen.high.u) {
            move_ends(seen.slice, seen.spans, frame_.beam_u[beam_ + 1], at_border_[beam_ % 2]);
            quads_.add(seen, *low, at_border_[beam_ % 2]);
            low = &at_border_[beam_ % 2];
            end_beam();
        }
        quads_.add(seen, *low, seen.high);
        if (frame_.beam_u[beam_ + 1] == seen.high.u) end_beam();
    }

  private:
    void end_beam() {
        quads_.end_beam();
        samples_.beam_begin[frame_.first_beam + ++beam_] =
            static_cast<std::uint32_t>(samples_.items.size());
        if (beam_ + 1 < std::ssize(frame_.beam_u)) slivers_.begin_beam(frame_.first_beam + beam_);
    }

    const SliceFrame& frame_;
    StripQuads& quads_;
    SliverBins& slivers_;
    Samples& samples_;
    MovedEnds at_border_[2];
    int beam_ = 0;  ///< of the frame, in which the next strip begins
};

class SlicesEngine final : public VisibilityEngine {
  public:
    SlicesEngine(const Scene& scene, const SlicesOptions& options)
        : scene_(&scene),
          options_(options),
          caster_(scene),
          surface_(scene),
          mesh_(make_clusters(scene)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const int per_beam =
            options_.per_beam > 0 ? options_.per_beam : slices_for(view.relative_l1);
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        Samples samples;
        samples.beam_begin.assign(view.beams + 1, 0);
        Disagreement sum;
        SliverBins slivers(view);
        for (const SliceFrame& frame : slice_frames(view, per_beam))
            see_frame(view, pose, frame, samples, slivers, sum);
        slivers.finish();
        samples.estimated_l1 = estimated_error(view.relative_l1, sum.share()) + slivers.error();
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return sonarsim::covered_bins(surface_, view, T_world_sensor);
    }

  private:
    void see_frame(const View& view, const LocalPose& pose, const SliceFrame& frame,
                   Samples& samples, SliverBins& slivers, Disagreement& sum) const {
        const PieceLimits limits = piece_limits(view);
        FrameScan scan(mesh_, *scene_, frame, pose, limits.range_max_m);
        AgreeingSlices agreeing(view, scene_->materials, scan);
        QuadSampler sampler(scan, scene_->materials, limits, slivers, samples.items);
        StripQuads quads(scan, limits, sampler);
        BeamCutter cutter(frame, quads, slivers, samples);
        const auto most = [&] {
            return options_.per_beam > 0 ? unlimited
                                         : disagreement_for(view.relative_l1, slivers.error());
        };
        while (agreeing.see_next(most())) {
            for (const SeenSlice* seen : agreeing.slices())
                cutter.add(*seen);
        }
        samples.dropped += scan.scene().dropped;
        sum.apart += agreeing.sum().apart;
        sum.signal += agreeing.sum().signal;
    }

    const Scene* scene_;
    SlicesOptions options_;
    Caster caster_;
    TriangleRuns surface_;
    ClusterMesh mesh_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene,
                                                     const SlicesOptions& options) {
    return std::make_unique<SlicesEngine>(scene, options);
}

}  // namespace sonarsim
