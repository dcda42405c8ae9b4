#include "simulate/visibility/slices/facet_extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// The plane of a triangle with neighbours is followed beyond the triangle by at most this share of
// the range, and no farther than the neighbours reach.
constexpr float neighbour_share = 0.002F;

constexpr FacetExtent unknown{{0.0F, 0.0F}, {-1.0F, -1.0F}};

Eigen::Vector3f place(const Corner& c) {
    return {c.X, c.U, c.W};
}

/// The range of a triangle. Its inside is nearer than its nearest corner by at most the sag of its
/// longest edge (L^2 / 8 r, doubled for safety), and no nearer than its plane, `height_m` away.
Interval range_of(const Corners& corners, float height_m) {
    const Eigen::Vector3f a = place(corners[0]);
    const Eigen::Vector3f b = place(corners[1]);
    const Eigen::Vector3f c = place(corners[2]);
    const auto [nearest, farthest] = std::minmax({a.norm(), b.norm(), c.norm()});
    const float edge2 =
        std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
    return {std::max(nearest - edge2 / (4.0F * nearest), height_m), farthest};
}

/// The range of a triangle's plane where the plane represents the neighbours as well. `all` is the
/// range of the triangle and its neighbours.
Interval followed(const Interval& own, const Interval& all) {
    return {std::max(all.from, own.from / (1.0F + neighbour_share)),
            std::min(all.to, own.to * (1.0F + neighbour_share))};
}

/// The u of corner k if it is the outermost in the direction of `sign`; else infinite.
float outermost(const FrontPart& part, int k, float sign) {
    for (int i = 0; i < part.count; ++i) {
        if (sign * part.corners[i].u > sign * part.corners[k].u) return sign * unbounded;
    }
    return part.corners[k].u;
}

}  // namespace

FacetExtents::FacetExtents(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
                           const SliceSetup& setup, const SliceScene& scene)
    : mesh_(mesh), vertices_(vertices), setup_(setup), scene_(scene) {}

const FacetExtent& FacetExtents::of(std::uint32_t facet_index) {
    if (facet_index >= known_.size()) known_.resize(scene_.facets.size(), unknown);
    FacetExtent& extent = known_[facet_index];
    if (extent.range_m.to < 0.0F) {
        const FrontFacet& facet = scene_.facets[facet_index];
        const Corners corners = setup_.corners_of(facet.facet);
        extent = {u_of(corners, facet.facet), range_of(corners, facet.height_m)};
        if (std::isinf(extent.u.from) || std::isinf(extent.u.to)) {
            extent.range_m =
                followed(extent.range_m, with_neighbours(corners, facet, extent.range_m));
        }
        const Interval& component = scene_.component_u[mesh_.facets[facet.facet].component];
        extent.u = {std::max(extent.u.from, component.from), std::min(extent.u.to, component.to)};
    }
    return extent;
}

/// Extends `all`, the range of a triangle, by the ranges of its neighbours.
Interval FacetExtents::with_neighbours(const Corners& corners, const FrontFacet& facet,
                                       Interval all) const {
    for (int side = 0; side < 3; ++side) {
        const std::uint32_t vertex = mesh_.beyond[facet.facet][side];
        if (vertex == ClusterMesh::nothing) continue;
        const Corner third = corner_at(setup_.in_frame(vertices_[vertex]), setup_.nearest_m());
        const Interval next = range_of({corners[side], corners[(side + 1) % 3], third}, 0.0F);
        all = {std::min(all.from, next.from), std::max(all.to, next.to)};
    }
    return all;
}

/// The surface ends at an outermost corner unless it continues beyond both sides that meet there.
Interval FacetExtents::u_of(const Corners& corners, std::uint32_t facet) const {
    const FrontPart part = part_in_front(corners, setup_.nearest_m());
    std::array<bool, 4> on{};
    for (int k = 0; k < part.count; ++k)
        on[k] = part.sides[k] == FrontPart::cut || goes_on(corners, part.sides[k], facet);
    Interval ends{-unbounded, unbounded};
    for (int k = 0; k < part.count; ++k) {
        if (on[k] && on[(k + part.count - 1) % part.count]) continue;
        ends.from = std::max(ends.from, outermost(part, k, -1.0F));
        ends.to = std::min(ends.to, outermost(part, k, 1.0F));
    }
    return ends;
}

/// True if, as the sonar sees them, the neighbour over a side and the triangle's third corner are
/// on opposite sides of this side.
bool FacetExtents::goes_on(const Corners& corners, int side, std::uint32_t facet) const {
    const std::uint32_t vertex = mesh_.beyond[facet][side];
    if (vertex == ClusterMesh::nothing) return false;
    const Eigen::Vector3f a = place(corners[side]);
    const Eigen::Vector3f across = a.cross(place(corners[(side + 1) % 3]) - a);
    const float own = across.dot(place(corners[(side + 2) % 3]) - a);
    const float other = across.dot(setup_.in_frame(vertices_[vertex]) - a);
    return own * other < 0.0F;
}

}  // namespace sonarsim
