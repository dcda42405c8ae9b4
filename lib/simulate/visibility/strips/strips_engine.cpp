#include "simulate/visibility/strips/strips_engine.h"

#include "simulate/visibility/strips/column_scan.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

StripsEngine::StripsEngine(const Scene& scene, const Caster& caster)
    : VisibilityEngine(scene, caster), mesh_(make_clusters(scene)) {}

Samples StripsEngine::visible_surface(const View& view, const Pose& T_world_sensor) const {
    const LocalPose pose = local_pose(T_world_sensor, scene().origin);
    const StripRule rule = strip_rule(view);
    const std::vector<std::uint32_t> clusters = clusters_in(view, T_world_sensor);
    Samples samples;
    samples.beam_begin.assign(view.beams + 1, 0);
    const std::size_t expected = last_samples_.load(std::memory_order_relaxed);
    samples.items.reserve(expected + expected / 8);
    for (const ColumnFrame& frame : strip_frames(view)) {
        const StripTriangles triangles =
            strip_triangles(mesh_, clusters, frame, pose, rule.range_max_m);
        scan(frame, triangles, pose, rule, samples);
        samples.dropped += triangles.dropped;
    }
    last_samples_.store(samples.items.size(), std::memory_order_relaxed);
    return samples;
}

/// Adds the samples of a frame's beams.
void StripsEngine::scan(const ColumnFrame& frame, const StripTriangles& triangles,
                        const LocalPose& pose, const StripRule& rule, Samples& samples) const {
    const int parts = column_parts(rule, triangles.thinness);
    const std::vector<float> u = column_borders(frame, parts);
    const Groups groups = triangles_by_column(triangles.items, u);
    ColumnScan columns(mesh_, triangles.items, frame, pose, rule, samples.items);
    for (std::size_t k = 0; k + 1 < u.size(); ++k) {
        columns.scan(
            std::span(groups.items).subspan(groups.begin[k], groups.begin[k + 1] - groups.begin[k]),
            u[k], u[k + 1]);
        samples.beam_begin[frame.beams[k / parts] + 1] =
            static_cast<std::uint32_t>(samples.items.size());
    }
}

std::vector<std::uint32_t> StripsEngine::clusters_in(const View& view, Pose T_local_sensor) const {
    T_local_sensor.translation -= scene().origin;
    const ViewVolume volume(view, T_local_sensor);
    const Eigen::Vector3f position = T_local_sensor.translation.cast<float>();
    std::vector<std::uint32_t> out;
    for (std::uint32_t k = 0; k < mesh_.clusters.size(); ++k) {
        const TriangleCluster& cluster = mesh_.clusters[k];
        if (volume.containment(cluster.centre - position, cluster.radius_m + volume.rounding_m()) !=
            Containment::outside)
            out.push_back(k);
    }
    return out;
}

}  // namespace sonarsim
