#include "simulate/visibility/strips/strips_engine.h"

#include "simulate/visibility/strips/column_scan.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

StripsEngine::StripsEngine(const Scene& scene, const Caster& caster)
    : VisibilityEngine(scene, caster), shared_(new Shared{SceneClusters(scene)}) {}

StripsEngine::StripsEngine(const StripsEngine& at_rest, const Caster& moved)
    : VisibilityEngine(at_rest.scene(), moved), shared_(at_rest.shared_) {}

Samples StripsEngine::visible_surface(const View& view, const Pose& T_world_sensor) const {
    const StripRule rule = strip_rule(view);
    const ClustersInView clusters = shared_->clusters.in_view(view, T_world_sensor, body_poses());
    Samples samples;
    samples.beam_begin.assign(view.beams + 1, 0);
    const std::size_t expected = shared_->last_samples.load(std::memory_order_relaxed);
    samples.items.reserve(expected + expected / 8);
    for (const ColumnFrame& frame : strip_frames(view)) {
        const StripTriangles triangles = strip_triangles(clusters, frame, rule.range_max_m);
        scan(frame, clusters, triangles, rule, samples);
        samples.dropped += triangles.dropped;
    }
    shared_->last_samples.store(samples.items.size(), std::memory_order_relaxed);
    return samples;
}

/// Adds the samples of a frame's beams.
void StripsEngine::scan(const ColumnFrame& frame, const ClustersInView& clusters,
                        const StripTriangles& triangles, const StripRule& rule, Samples& samples) {
    const int parts = column_parts(rule, triangles.thinness);
    const std::vector<float> u = column_borders(frame, parts);
    const Groups groups = triangles_by_column(triangles.items, u);
    ColumnScan columns(clusters, triangles.items, frame, rule, samples.items);
    for (std::size_t k = 0; k + 1 < u.size(); ++k) {
        columns.scan(
            std::span(groups.items).subspan(groups.begin[k], groups.begin[k + 1] - groups.begin[k]),
            u[k], u[k + 1]);
        samples.beam_begin[frame.beams[k / parts] + 1] =
            static_cast<std::uint32_t>(samples.items.size());
    }
}

}  // namespace sonarsim
