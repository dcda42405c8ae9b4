#include "simulate/visibility/strips/strips.h"

#include "simulate/visibility/strips/column_scan.h"
#include "simulate/visibility/strips/strip_rule.h"
#include "simulate/visibility/strips/strip_triangles.h"

namespace sonarsim {

namespace {

/// Adds the samples of a frame's beams.
void scan(const ColumnFrame& frame, const ClustersInView& clusters, const StripTriangles& triangles,
          const StripRule& rule, Samples& samples) {
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

}  // namespace

Samples strips_surface(const ClustersInView& clusters, const View& view, std::size_t expected) {
    const StripRule rule = strip_rule(view);
    Samples samples;
    samples.beam_begin.assign(view.beams + 1, 0);
    samples.items.reserve(expected + expected / 8);
    for (const ColumnFrame& frame : strip_frames(view)) {
        const StripTriangles triangles = strip_triangles(clusters, frame, rule.range_max_m);
        scan(frame, clusters, triangles, rule, samples);
        samples.dropped += triangles.dropped;
    }
    return samples;
}

}  // namespace sonarsim
