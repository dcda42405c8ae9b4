#include "visibility/slices/merge_spans.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// Planes are one when their normals differ by less, and their heights by less than this share of
// the distance: what float corners leave of a wall that was flat.
constexpr float most_tilt = 2e-5F;

bool one_surface(const ClusterMesh& mesh, const SliceScene& scene, const VisibleSpan& a,
                 const VisibleSpan& b) {
    if (!(b.w_low - a.w_high <= 4e-6F * (1.0F + std::fabs(a.w_high)))) return false;
    const SeenFacet& f = scene.facets[scene.trapezoids[a.trapezoid].seen];
    const SeenFacet& g = scene.facets[scene.trapezoids[b.trapezoid].seen];
    if ((f.normal - g.normal).squaredNorm() > most_tilt * most_tilt) return false;
    if (std::fabs(f.height_m - g.height_m) > most_tilt * std::min(f.range_m.to, g.range_m.to)) {
        return false;
    }
    const SliceFacet& s = mesh.facets[f.facet];
    const SliceFacet& t = mesh.facets[g.facet];
    return s.material == t.material && s.instance == t.instance;
}

}  // namespace

void merge_coplanar_spans(const ClusterMesh& mesh, const SliceScene& scene,
                          std::vector<VisibleSpan>& spans) {
    if (spans.empty()) return;
    std::size_t last = 0;
    for (std::size_t i = 1; i < spans.size(); ++i) {
        VisibleSpan& a = spans[last];
        const VisibleSpan& b = spans[i];
        if (!one_surface(mesh, scene, a, b)) {
            spans[++last] = b;
            continue;
        }
        a.w_high = b.w_high;
        a.q_high = b.q_high;
        a.high = b.high;
        a.ends = {std::min(a.ends.from, b.ends.from), std::max(a.ends.to, b.ends.to)};
        a.range_m = {std::min(a.range_m.from, b.range_m.from),
                     std::max(a.range_m.to, b.range_m.to)};
    }
    spans.resize(last + 1);
}

}  // namespace sonarsim
