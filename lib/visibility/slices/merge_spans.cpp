#include "visibility/slices/merge_spans.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// Planes are equal if their normals differ by less than this, and their heights by less than this
// share of the distance: float corners of a flat wall differ by as much.
constexpr float most_tilt = 2e-5F;

Interval around(const Interval& a, const Interval& b) {
    return {std::min(a.from, b.from), std::max(a.to, b.to)};
}

bool touch(const VisibleSpan& a, const VisibleSpan& b) {
    return b.w_low - a.w_high <= 4e-6F * (1.0F + std::fabs(a.w_high));
}

}  // namespace

bool one_plane(const ClusterMesh& mesh, const SliceScene& scene, std::uint32_t a, std::uint32_t b,
               float range_m) {
    if (a == b) return true;
    const FrontFacet& f = scene.facets[a];
    const FrontFacet& g = scene.facets[b];
    if ((f.normal - g.normal).squaredNorm() > most_tilt * most_tilt) return false;
    if (std::fabs(f.height_m - g.height_m) > most_tilt * range_m) return false;
    const SliceFacet& s = mesh.facets[f.facet];
    const SliceFacet& t = mesh.facets[g.facet];
    return s.material == t.material && s.instance == t.instance;
}

void merge_coplanar_spans(const ClusterMesh& mesh, const SliceScene& scene,
                          std::vector<VisibleSpan>& spans) {
    if (spans.empty()) return;
    std::size_t last = 0;
    for (std::size_t i = 1; i < spans.size(); ++i) {
        VisibleSpan& a = spans[last];
        const VisibleSpan& b = spans[i];
        const float farthest = std::min(a.facet_extent.range_m.to, b.facet_extent.range_m.to);
        if (!touch(a, b) || !one_plane(mesh, scene, a.facet_index, b.facet_index, farthest)) {
            spans[++last] = b;
            continue;
        }
        a.w_high = b.w_high;
        a.q_high = b.q_high;
        a.high = b.high;
        a.facet_extent.u = around(a.facet_extent.u, b.facet_extent.u);
        a.facet_extent.range_m = around(a.facet_extent.range_m, b.facet_extent.range_m);
    }
    spans.resize(last + 1);
}

}  // namespace sonarsim
